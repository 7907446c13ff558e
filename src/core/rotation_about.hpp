#pragma once

#include <Eigen/Core>

#include "condyle/pose.hpp"
#include "core/trigonometry.hpp"

namespace condyle::core {

/// The rotation about a unit vector, with the same bits everywhere: Eigen::AngleAxis has those of the C library.
inline Eigen::Matrix3d rotation_about(const Eigen::Vector3d& axis, double radians) noexcept {
  const auto [sine, cosine] = sine_cosine(radians);
  const double x = axis.x(), y = axis.y(), z = axis.z(), rest = 1 - cosine;
  Eigen::Matrix3d R;
  R << rest * x * x + cosine, rest * x * y - sine * z, rest * x * z + sine * y,  //
      rest * x * y + sine * z, rest * y * y + cosine, rest * y * z - sine * x,   //
      rest * x * z - sine * y, rest * y * z + sine * x, rest * z * z + cosine;
  return R;
}

/// The pose after a small motion in F: translation of its origin, then rotation about it (rad).
inline Pose moved_by(const Pose& X, const Vec3& translation, const Vec3& rotation) noexcept {
  Pose out = X;
  out.translation() += translation;
  if (const double angle = rotation.norm(); angle > 0)
    out.linear() = rotation_about(rotation / angle, angle) * X.linear();
  return out;
}

}  // namespace condyle::core
