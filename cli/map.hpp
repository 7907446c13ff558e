#pragma once

#include "condyle/limit_band.hpp"
#include "condyle/motion_map.hpp"

namespace condyle::cli {

/// Computes the map and shows how far it is. Throws Interrupted on SIGINT or SIGTERM.
MotionMap computed_map(const MapGrid& grid, const RangeOfMotion& range);

/// The same of the bands of limits.
std::vector<LimitBand> computed_bands(const Joint& joint, std::span<const Motion> motions,
                                      const RangeOptions& range, const BandOptions& options);

}  // namespace condyle::cli
