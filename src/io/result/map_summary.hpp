#pragma once

#include <array>
#include <cstddef>

#include "condyle/motion_map.hpp"

namespace condyle {

/// At how many points of a map one end has each reason.
struct ReasonCounts {
  std::array<std::size_t, 3> of{};

  std::size_t operator[](LimitReason reason) const { return of[static_cast<std::size_t>(reason)]; }
};

/// What a map comes to.
struct MapSummary {
  ReasonCounts negative_ends, positive_ends;
  FreeVolume volume;
};

inline MapSummary summarise(const MotionMap& map) {
  MapSummary summary;
  for (const RotationLimits& point : map.points) {
    ++summary.negative_ends.of[static_cast<std::size_t>(point.negative.reason)];
    ++summary.positive_ends.of[static_cast<std::size_t>(point.positive.reason)];
  }
  summary.volume = free_volume(map);
  return summary;
}

}  // namespace condyle
