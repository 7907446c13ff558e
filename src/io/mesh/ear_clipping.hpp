#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "condyle/pose.hpp"

namespace condyle::io {

/// Triangles of a polygon, by the numbers of its corners and wound as it is: all turn as it does in the coordinate plane that its
/// normal is nearest to, or have no area there. They cover every point of that plane as often as the polygon winds round it, so
/// that a flat polygon has its own area, whatever its shape, also where corners lie on a line or on one another. Empty if the
/// polygon crosses itself. The signs that decide are exact.
std::vector<std::array<std::size_t, 3>> clipped_ears(const std::vector<Vec3>& corners, const Vec3& normal);

}  // namespace condyle::io
