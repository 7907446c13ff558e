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

/// Many points moved by a pose; out may hold any size before.
void posed(const Pose& X, PointsView points, Points& out);
Points posed(const Pose& X, PointsView points);

}  // namespace condyle
