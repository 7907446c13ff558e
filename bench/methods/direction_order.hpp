#pragma once

#include <vector>

#include "condyle/pose.hpp"

namespace bench {

/// Numbers of the points in an order in which neighbours lie in nearly one direction from the origin: face by
/// face of a cube map, along a Z-curve on each face, outwards within a cell.
std::vector<condyle::Index> by_direction(condyle::PointsView points);

}  // namespace bench
