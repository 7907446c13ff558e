#pragma once

#include "condyle/motion_map.hpp"

namespace condyle::cli {

/// Computes the map and shows how far it is. Throws Interrupted on SIGINT or SIGTERM.
MotionMap computed_map(const MapGrid& grid, const RangeOfMotion& range);

}  // namespace condyle::cli
