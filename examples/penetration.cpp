// Where and how deep a ball penetrates its socket, with the core library alone.
#include <cstdio>

#include "contact/joint_contact.hpp"
#include "shapes.hpp"

int main() {
  // Any two closed triangle meshes, in millimetres, with the joint centre as origin.
  const condyle::TriMesh socket = examples::socket(25.0), ball = examples::ball(24.8);

  // Tables are built once; every pose reuses them.
  const condyle::JointContact joint(socket, ball);
  condyle::Pose X_FM = condyle::Pose::Identity();  // p_fixed = X_FM * p_mobile
  X_FM.translation() = condyle::Vec3(0, 0.5, 0);   // the ball rides up by half a millimetre
  const condyle::RadialContact contact = joint.radial(X_FM);

  double deepest = 0;
  for (const double gap : contact.mobile_in_fixed->radial_gap) deepest = std::min(deepest, gap);
  std::printf("in contact: %s, %zu triangle pairs, deepest %.3f mm\n", contact.in_contact ? "yes" : "no",
              contact.pairs.size(), -deepest);
}
