#pragma once

#include "condyle/pose.hpp"

namespace condyle::test {

/// Turned by an angle, rad, about an axis of any length, and moved.
inline Pose some_pose(double angle, const Vec3& axis, const Vec3& place) {
  Pose X = Pose::Identity();
  X.linear() = Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
  X.translation() = place;
  return X;
}

}  // namespace condyle::test
