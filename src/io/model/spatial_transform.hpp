#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "condyle/pose.hpp"
#include "io/model/model_function.hpp"

namespace condyle::io {

/// One of the six axes of a joint and how far the joint turns about it or moves along it.
struct TransformAxis {
  std::vector<std::size_t> coordinates = {};  ///< of the joint, in the order in which the function takes them
  Vec3 axis = Vec3::UnitX();                  ///< unit, in the joint's frame in the parent
  ModelFunction function = ConstantFunction{};

  double value(std::span<const double> q) const;
};

/// Three rotations, each about its axis as the earlier ones left it, then three translations along axes of the joint's frame
/// in the parent, not turned: X_FM of every joint of OpenSim that is read here. Radians and metres.
using SpatialTransform = std::array<TransformAxis, 6>;

/// The functions that pose a ModelJoint.
struct ModelTransform {
  SpatialTransform axes;
};

/// dependent = scale * function(independent ones).
struct CouplerFunction {
  double scale = 1;
  ModelFunction function = ConstantFunction{};
};

/// X_FM at these coordinates.
Pose pose_of(const SpatialTransform& transform, std::span<const double> q);

/// R(axis, angle), the axis unit.
Eigen::Matrix3d rotation_about(const Vec3& axis, double radians);

/// R = Rx(angles[0]) Ry(angles[1]) Rz(angles[2]), as a model gives orientations of frames.
Eigen::Matrix3d body_fixed_xyz(const Vec3& angles);

}  // namespace condyle::io
