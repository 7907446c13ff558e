#pragma once

#include <array>
#include <vector>

#include "condyle/pose.hpp"

namespace condyle::plan {

/// Points of a triangle at most this far apart, its corners among them: in rows along its longest side.
std::vector<Vec3> points_of_triangle(const std::array<Vec3, 3>& corners, double spacing_mm);

}  // namespace condyle::plan
