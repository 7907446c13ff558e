#pragma once

#include "measure/measure_bones.hpp"
#include "motion/rom/displacement.hpp"

namespace condyle::measure {

/// The joint that all samples of a band are displaced from, and what was found on it.
class DisplacedBones {
 public:
  /// The request must outlive it.
  DisplacedBones(const Joint& joint, const MeasureRequest& request, const Uncertainty& sigma);

  /// In the frame G of the displaced joint, to which both bones are brought: p_G = X_FG^-1 p. From any thread.
  HipMeasures measured(const motion::Displacement& by) const;

 private:
  FoundParts placed_parts(const Bones& bones, const Eigen::Matrix3d& R_GF) const;

  CoordinateSystem system_;
  const MeasureRequest& request_;
  BoneMeshes meshes_;
  FoundParts parts_;
  motion::MovableSurface hip_bone_, femur_;
};

}  // namespace condyle::measure
