#include "map.hpp"

#include <fmt/format.h>

#include <stop_token>
#include <utility>

#include "interrupt.hpp"
#include "progress.hpp"

namespace condyle::cli {

MotionMap computed_map(const MapGrid& grid, const RangeOfMotion& range) {
  const InterruptWatch watch;
  std::stop_source stop;
  Progress progress("map points");
  std::size_t done = 0;
  std::optional<MotionMap> map = motion_map(grid, range,
                                            {.progress =
                                                 [&](std::size_t now_done, std::size_t total) {
                                                   done = now_done;
                                                   progress.update(done, total);
                                                   if (watch.interrupted()) stop.request_stop();
                                                 },
                                             .stop = stop.get_token()});
  if (!map)
    throw Interrupted(
        fmt::format("interrupted after {} of {} map points; nothing is written", done, grid.size()));
  return std::move(*map);
}

}  // namespace condyle::cli
