#include "map.hpp"

#include <stop_token>

#include "followed.hpp"

namespace condyle::cli {

MotionMap computed_map(const MapGrid& grid, const RangeOfMotion& range) {
  return followed("map points", [&](const auto& follow, std::stop_token stop) {
    return motion_map(grid, range, {.progress = follow, .stop = stop});
  });
}

std::vector<LimitBand> computed_bands(const Joint& joint, std::span<const Motion> motions,
                                      const RangeOptions& range, const BandOptions& options) {
  return followed("joints of the band", [&](const auto& follow, std::stop_token stop) {
    return limit_bands(joint, motions, range, options, {.progress = follow, .stop = stop});
  });
}

}  // namespace condyle::cli
