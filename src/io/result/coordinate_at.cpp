#include "io/result/coordinate_at.hpp"

#include "condyle/range_of_motion.hpp"

namespace condyle::io {

double coordinate_at(const Joint& joint, const Pose& X_FM, std::size_t number) {
  const auto at = coordinates_at(joint.coordinates(), X_FM, joint.translation_frame);
  constexpr std::size_t angles = all_joint_angles.size();
  return number < angles ? angle_of(at.angles, all_joint_angles[number]).degrees()
                         : at.translation_mm[static_cast<Eigen::Index>(number - angles)];
}

}  // namespace condyle::io
