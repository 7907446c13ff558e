#pragma once

#include <fmt/format.h>

#include <stop_token>
#include <utility>

#include "interrupt.hpp"
#include "progress.hpp"

namespace condyle::cli {

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

}  // namespace condyle::cli
