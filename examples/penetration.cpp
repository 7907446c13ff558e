// How deep the femur of the sample hip penetrates the hip bone: `condyle sample hip --scenario 2 --out sample` first.
#include <condyle/condyle.hpp>
#include <condyle/io/joint_file.hpp>
#include <cstdio>

int main() {
  const condyle::Joint hip = condyle::io::read_joint("sample/hip.toml").joint;
  const condyle::contact::JointContact contact(hip);  // tables and trees, built once and asked at any pose
  const condyle::JointAngles flexed{condyle::Angle::degrees(140), {}, {}};
  const auto X_FM = condyle::pose_at(hip.coordinates(), flexed);  // p_fixed = X_FM * p_mobile
  const auto answer = condyle::answer_depth(contact, hip, {.X_FM = X_FM, .deepest_place = true});
  const auto& rays = std::get<condyle::RayDepths>(answer.depths);
  const auto deepest = condyle::contact::deepest_of(rays.reliable);
  std::printf("depth %.2f mm to the surface, %.2f along the ray, volume %.1f mm3; %zu triangle pairs\n",
              answer.deepest_place ? answer.deepest_place->depth_mm : 0.0,
              deepest ? deepest->vertex.depth_mm : 0.0, answer.measures.volume_mm3.value_or(0),
              rays.contact.pairs.size());
}
