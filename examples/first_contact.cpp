// How far a door rotates before it meets a post: in closed form, without a step size.
#include "condyle/first_contact.hpp"

#include <cstdio>

#include "shapes.hpp"

int main() {
  condyle::TriMesh post = examples::ball(1.0), door = examples::ball(2.0);
  for (std::size_t i = 0; i < post.vertices.size(); ++i) {
    post.vertices.set(i, post.vertices[i] + condyle::Vec3(0, 10, 0));  // ten millimetres away along y
    door.vertices.set(i, door.vertices[i] + condyle::Vec3(10, 0, 0));  // ten millimetres away along x
  }

  // The axis through the origin along z; positive angles go from x towards y.
  const condyle::AxisFrame axis(condyle::Vec3::Zero(), condyle::Vec3::UnitZ());
  const condyle::motion::FirstContact first_contact(post, door, axis);
  const condyle::motion::RotationLimits limits = first_contact.limits();
  std::printf("turns %.9f deg one way and %.9f deg the other before they touch\n",
              limits.positive.turned.degrees(), limits.negative.turned.degrees());
}
