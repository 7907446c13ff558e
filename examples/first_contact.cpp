// How far a door turns before it meets a post: in closed form, without a step size.
#include <cstdio>

#include "motion/search/first_contact.hpp"
#include "shapes.hpp"

int main() {
  condyle::TriMesh post = examples::ball(1.0), door = examples::ball(2.0);
  for (std::size_t i = 0; i < post.vertices.size(); ++i) {
    post.vertices.set(i, post.vertices[i] + condyle::Vec3(0, 10, 0));  // ten millimetres away along y
    door.vertices.set(i, door.vertices[i] + condyle::Vec3(10, 0, 0));  // ten millimetres away along x
  }

  // The axis through the origin along z; positive angles turn x towards y.
  const condyle::AxisFrame axis(condyle::Vec3::Zero(), condyle::Vec3::UnitZ());
  const condyle::motion::FeatureTree post_features(post), door_features(door);
  const condyle::motion::RotationTable table(post_features, axis);
  condyle::motion::TurningBody turning(door_features);
  turning.start_at(axis, condyle::Pose::Identity());

  const condyle::TurnLimits limits = condyle::motion::first_contact(table, turning);
  std::printf("turns %.9f deg one way and %.9f deg the other before they touch\n",
              limits.positive.angle.degrees(), -limits.negative.angle.degrees());
}
