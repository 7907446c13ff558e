// Where and how deep the femur of the sample hip penetrates the hip bone: `condyle sample hip --out sample` first.
#include <algorithm>
#include <condyle/condyle.hpp>
#include <condyle/io/joint_file.hpp>
#include <cstdio>

int main() {
  const condyle::Joint hip = condyle::read_joint("sample/hip.toml").joint;
  const condyle::JointContact contact(hip);  // tables and trees, built once and asked at any pose
  const condyle::JointAngles flexed{condyle::Angle::degrees(140), {}, {}};
  const auto X_FM = condyle::pose_at(hip.coordinates(), flexed);  // p_fixed = X_FM * p_mobile
  const condyle::Contact at = contact.at(X_FM);
  const condyle::Penetrations& femur = *at.mobile_in_fixed;  // its vertices inside the hip bone
  double deepest_mm = 0;
  for (const double depth_mm : femur.depth_mm) deepest_mm = std::max(deepest_mm, depth_mm);
  std::printf("%zu vertices inside, radial depth up to %.2f mm; %zu triangle pairs\n", femur.size(),
              deepest_mm, at.pairs.size());
}
