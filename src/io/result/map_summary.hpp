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
  std::size_t free_elsewhere = 0;  ///< points in contact at the start that are free at other angles
  std::size_t with_islands = 0;    ///< points with a free interval beyond the one that is drawn
  FreeVolume volume;
};

inline MapSummary summarise(const MotionMap& map) {
  MapSummary summary;
  for (const FreeAngles& point : map.points) {
    ++summary.negative_ends.of[static_cast<std::size_t>(point.from_start.negative.reason)];
    ++summary.positive_ends.of[static_cast<std::size_t>(point.from_start.positive.reason)];
    summary.free_elsewhere += !point.from_start.free_at_start() && !point.intervals.empty();
    summary.with_islands += point.intervals.size() > 1;
  }
  summary.volume = free_volume(map);
  return summary;
}

}  // namespace condyle
