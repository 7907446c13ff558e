#pragma once

#include "condyle/pose.hpp"

namespace condyle::core {

/// The matrix of v x: cross_matrix(v) * w is v.cross(w).
inline Eigen::Matrix3d cross_matrix(const Vec3& v) {
  Eigen::Matrix3d m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

}  // namespace condyle::core
