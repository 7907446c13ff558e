#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "condyle/motion_map.hpp"

namespace condyle::io {

/// At how many points of a map one end has each reason.
struct ReasonCounts {
  std::array<std::size_t, 5> of{};

  std::size_t operator[](motion::LimitReason reason) const { return of[static_cast<std::size_t>(reason)]; }
};

/// Summary of a map.
struct MapSummary {
  ReasonCounts negative_ends, positive_ends;
  std::size_t free_elsewhere = 0;  ///< points in contact at the start that are free at other values
  std::size_t with_islands = 0;    ///< points with a free interval beyond the one that is drawn
  motion::FreeVolume volume;
};

inline MapSummary map_summary_of(const motion::MotionMap& map) {
  MapSummary summary;
  for (std::size_t i = 0; i < map.grid.size(); ++i) {
    const motion::MapPoint point = map.point(i);
    ++summary.negative_ends.of[static_cast<std::size_t>(point.negative.reason)];
    ++summary.positive_ends.of[static_cast<std::size_t>(point.positive.reason)];
    summary.free_elsewhere += !point.free_at_start() && !point.intervals.empty();
    summary.with_islands += point.intervals.size() > 1;
  }
  summary.volume = motion::free_volume(map);
  return summary;
}

/// All free intervals of a map, point by point:
///
///   offset     0     2  2        5  ...      one per point, plus one
///   low       | a b |  | c d e |    ...      point i owns [offset[i], offset[i+1])
struct MapIntervals {
  std::vector<std::size_t> offset = {0};
  std::vector<double> low, high;  ///< values of the varied coordinate
  std::vector<motion::LimitReason> low_reason, high_reason;
};

inline MapIntervals all_intervals(const motion::MotionMap& map) {
  MapIntervals all;
  for (std::size_t i = 0; i < map.grid.size(); ++i) {
    for (const motion::MapInterval& free : map.point(i).intervals) {
      all.low.push_back(free.low.value);
      all.high.push_back(free.high.value);
      all.low_reason.push_back(free.low.reason);
      all.high_reason.push_back(free.high.reason);
    }
    all.offset.push_back(all.low.size());
  }
  return all;
}

}  // namespace condyle::io
