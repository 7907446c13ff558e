#pragma once

#include <random>

#include "condyle/angle.hpp"
#include "condyle/pose.hpp"
#include "core/rotation_about.hpp"

namespace condyle::test {

inline Pose at(const Vec3& translation) {
  return Pose(Eigen::Translation3d(translation));
}

/// Turned about an axis of any length, then moved.
inline Pose rotated(double degrees, const Vec3& axis, const Vec3& shift = Vec3::Zero()) {
  Pose X = at(shift);
  X.linear() = Eigen::AngleAxisd(Angle::degrees(degrees).radians(), axis.normalized()).toRotationMatrix();
  return X;
}

/// Turned anyhow, and moved by up to `reach` along each axis.
inline Pose random_pose(std::mt19937& random, double reach) {
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> angle(-3, 3), place(-reach, reach);
  Pose X = at({place(random), place(random), place(random)});
  X.linear() =
      core::rotation_about(Vec3(normal(random), normal(random), normal(random)).normalized(), angle(random));
  return X;
}

}  // namespace condyle::test
