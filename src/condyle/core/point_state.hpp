#pragma once

#include <cstdint>

namespace condyle {

/// Where a point stands to a solid, decided exactly. `inside` is strictly inside: off the surface, winding
/// number > 0.
enum class PointState : std::uint8_t { outside, on_surface, inside };

}  // namespace condyle
