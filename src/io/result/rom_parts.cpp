#include "io/result/rom_parts.hpp"

#include "condyle/io/pose_text.hpp"
#include "condyle/joint_checks.hpp"

namespace condyle::io {

Json zero_json(const Joint& joint) {
  const ZeroPose zero = zero_pose(joint);
  return {
      {"from", name_of(zero.from)},
      {"is_neutral", joint.is_hip() ? Json(zero.is_neutral()) : Json(nullptr)},
      {"femur_deg", zero.femur ? pose_json({zero.femur->flexion.degrees(), zero.femur->adduction.degrees(),
                                            zero.femur->internal_rotation.degrees()},
                                           joint.anatomy)
                               : Json(nullptr)},
      {"text", zero_text(joint, zero)}};
}

std::vector<OppositeLimits> opposite_limits(std::span<const motion::MotionLimit> limits) {
  const auto ends = [](const motion::MotionLimit& limit) {
    return limit.end.reason == motion::LimitReason::contact && !limit.translation_ends &&
           limit.end.kind() != motion::ContactKind::cut;
  };
  std::vector<OppositeLimits> pairs;
  for (std::size_t i = 0; i < limits.size(); ++i)
    for (std::size_t j = i + 1; j < limits.size(); ++j)
      if (const motion::Motion& a = limits[i].motion, &b = limits[j].motion;
          a.vary == b.vary && a.sense != b.sense && a.start == b.start && ends(limits[i]) && ends(limits[j]))
        pairs.push_back({&limits[i], &limits[j]});
  return pairs;
}

}  // namespace condyle::io
