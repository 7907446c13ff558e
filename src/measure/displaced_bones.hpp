#pragma once

#include "measure/measure_bones.hpp"
#include "motion/rom/displacement.hpp"

namespace condyle::measure {

/// The joint that all samples of a band are displaced from, and what was found on it.
class DisplacedBones {
 public:
  /// The request must outlive it.
  DisplacedBones(const Joint& joint, const MeasureOptions& request, const motion::Uncertainty& sigma);

  /// In the frame G of the displaced joint, to which both bones are brought: p_G = X_FG^-1 p. From any thread.
  HipMeasures measured(const motion::Displacement& by) const;

 private:
  BoneParts placed_parts(const Bones& bones, const Eigen::Matrix3d& R_GF,
                         std::span<const double> parameters) const;

  CoordinateSystem system_;
  const MeasureOptions& request_;
  BoneMeshes meshes_;
  BoneParts parts_;
  motion::MovableSurface hip_bone_, femur_;
  kinematics::DisplacedParts hip_bone_parts_, femur_parts_;
  std::size_t of_socket_ = 0, of_head_ = 0;  ///< the groups of vertices that these lie on
};

}  // namespace condyle::measure
