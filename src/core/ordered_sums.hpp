#pragma once

#include <Eigen/Core>
#include <cmath>

#include "condyle/pose.hpp"

/// Sums of products in one order, whatever the instruction set: Eigen's own order depends on whether it has vectors of two doubles, and
/// the core as WebAssembly has none.

namespace condyle::core {

inline double ordered_dot(const Vec3& a, const Vec3& b) noexcept {
  return (a.x() * b.x() + a.y() * b.y()) + a.z() * b.z();
}

/// a v
inline Vec3 ordered_image(const Eigen::Matrix3d& a, const Vec3& v) noexcept {
  return {ordered_dot(a.row(0), v), ordered_dot(a.row(1), v), ordered_dot(a.row(2), v)};
}

/// a b
inline Eigen::Matrix3d ordered_product(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b) noexcept {
  Eigen::Matrix3d product;
  for (int k = 0; k < 3; ++k) product.col(k) = ordered_image(a, b.col(k));
  return product;
}

inline double ordered_norm(const Vec3& v) noexcept {
  return std::sqrt(ordered_dot(v, v));
}

/// Scaled to length 1, whatever its length; zero stays zero. Like Eigen's stableNormalized().
inline Vec3 ordered_direction(const Vec3& v) noexcept {
  const double largest = v.cwiseAbs().maxCoeff();
  if (!(largest > 0)) return v;
  return v / (ordered_norm(v / largest) * largest);
}

}  // namespace condyle::core
