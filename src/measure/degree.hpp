#pragma once

#include <numbers>

namespace condyle::measure {

/// In radians.
inline constexpr double degree = std::numbers::pi / 180;

}  // namespace condyle::measure
