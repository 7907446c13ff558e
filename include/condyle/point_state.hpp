#pragma once

#include <cstdint>

namespace condyle {

/// Where a point stands to a closed surface: decided by the winding number w, exactly. `inside` is strictly
/// inside, w > 0; `on_surface` is exactly on a triangle, an edge or a vertex.
enum class PointState : std::uint8_t { outside, on_surface, inside };

}  // namespace condyle
