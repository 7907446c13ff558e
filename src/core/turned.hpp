#pragma once

#include "condyle/pose.hpp"

namespace condyle::core {

/// A direction turned by a pose, its products summed in one order whatever the instruction set, as by posed().
inline Vec3 turned(const Pose& X, const Vec3& v) noexcept {
  const auto& m = X.matrix();
  const auto row = [&](int i) { return (m(i, 0) * v.x() + m(i, 1) * v.y()) + m(i, 2) * v.z(); };
  return {row(0), row(1), row(2)};
}

}  // namespace condyle::core
