#include "map.hpp"

#include <fmt/format.h>

#include <stop_token>
#include <utility>

#include "interrupt.hpp"
#include "progress.hpp"

namespace condyle::cli {

namespace {

/// Asks `compute` for an answer with something that follows its progress and stops it on SIGINT or SIGTERM; an answer
/// that was stopped is empty.
template <class Compute>
auto followed(const char* what, const Compute& compute) {
  const InterruptWatch watch;
  std::stop_source stop;
  Progress progress(what);
  std::size_t done = 0, total = 0;
  const auto follow = [&](std::size_t now_done, std::size_t of) {
    done = now_done, total = of;
    progress.update(done, total);
    if (watch.interrupted()) stop.request_stop();
  };
  auto answer = compute(follow, stop.get_token());
  if (!answer)
    throw Interrupted(fmt::format("interrupted after {} of {} {}; nothing is written", done, total, what));
  return std::move(*answer);
}

}  // namespace

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
