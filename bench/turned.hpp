#pragma once

#include "condyle/pose.hpp"
#include "condyle/radial.hpp"

namespace bench {

/// Moves every point by a pose, in vectors of floats, and returns the greatest coordinate there is then: what
/// reading and turning the points costs, which no method that looks at each of them can do without.
float greatest_turned(const condyle::radial::SortedPoints& points, const condyle::Pose& X);

}  // namespace bench
