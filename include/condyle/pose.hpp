#pragma once

#include "condyle/points.hpp"

namespace condyle {

/// A rigid motion. X_FM is the pose of mobile M measured in fixed F: p_F = X_FM * p_M.
using Pose = Eigen::Isometry3d;

/// One point moved by a pose, its products and sums rounded in one fixed order, so that the same input
/// gives the same bits on every instruction set.
inline Vec3 posed(const Pose& X, const Vec3& p) noexcept {
  const auto& m = X.matrix();
  const auto row = [&](int i) { return ((m(i, 0) * p.x() + m(i, 1) * p.y()) + m(i, 2) * p.z()) + m(i, 3); };
  return {row(0), row(1), row(2)};
}

/// The inverse pose, its sums in one fixed order too. The last coordinate's order differs from the others' as Eigen's
/// does when it vectorises: stored results keep their bits.
inline Pose inverted(const Pose& X) noexcept {
  const auto& m = X.matrix();
  Pose out = Pose::Identity();
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) out.matrix()(i, k) = m(k, i);
    const double a = -m(0, i) * m(0, 3), b = -m(1, i) * m(1, 3), c = -m(2, i) * m(2, 3);
    out.matrix()(i, 3) = i < 2 ? (a + b) + c : a + (b + c);
  }
  return out;
}

/// Many points moved by a pose; out may hold any size before.
void posed(const Pose& X, PointsView points, Points& out);
Points posed(const Pose& X, PointsView points);

}  // namespace condyle
