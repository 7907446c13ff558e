#pragma once

#include <fmt/format.h>

#include <cmath>
#include <string>

#include "condyle/pose.hpp"

namespace condyle::io {

/// What rounding leaves of zero mm or degrees, below 1e-12, is zero for people, without a minus sign.
inline double shown(double value) noexcept {
  return std::abs(value) < 1e-12 ? 0.0 : value;
}

/// "(1, -2.5, 0)", in six digits.
inline std::string shown(const Vec3& p) {
  return fmt::format("({:.6g}, {:.6g}, {:.6g})", shown(p.x()), shown(p.y()), shown(p.z()));
}

}  // namespace condyle::io
