// How deep the femur of the sample hip penetrates the hip bone: `condyle sample hip --out sample` first.
#include <condyle/condyle.hpp>
#include <condyle/io/joint_file.hpp>
#include <cstdio>

int main() {
  const condyle::Joint hip = condyle::read_joint("sample/hip.toml").joint;
  const condyle::JointContact contact(hip);  // tables and trees, built once and asked at any pose
  const condyle::JointAngles flexed{condyle::Angle::degrees(140), {}, {}};
  const auto X_FM = condyle::pose_at(hip.coordinates(), flexed);  // p_fixed = X_FM * p_mobile
  const auto at = condyle::depth_at(contact, hip, flexed, X_FM, condyle::DepthMethod::reliable,
                                    condyle::DistancesOf::vertices_inside);
  const auto deepest = condyle::deepest_of(at.reliable);
  std::printf("depth %.2f mm, volume %.1f mm3; %zu triangle pairs\n",
              deepest ? deepest->vertex.depth_mm : 0.0, at.measures.volume_mm3.value_or(0),
              at.contact.pairs.size());
}
