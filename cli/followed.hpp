#pragma once

#include <fmt/format.h>

#include <optional>
#include <stop_token>
#include <string>
#include <string_view>
#include <utility>

#include "condyle/answer.hpp"
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

/// The same of an answer whose stages report by name. Before its first stage a signal ends the process as ever.
template <class Compute>
auto followed_by_stage(const Compute& compute) {
  std::optional<InterruptWatch> watch;
  std::optional<Progress> progress;
  std::stop_source stop;
  std::string what;
  std::size_t done = 0, total = 0;
  const auto follow = [&](std::string_view stage, std::size_t now_done, std::size_t of) {
    if (!watch) watch.emplace();
    if (what != stage) progress.emplace(what = stage);
    done = now_done, total = of;
    progress->update(done, total);
    if (watch->interrupted()) stop.request_stop();
  };
  auto answer = compute(AnswerControl{follow, stop.get_token()});
  if (!answer)
    throw Interrupted(fmt::format("interrupted after {} of {} {}; nothing is written", done, total, what));
  return std::move(*answer);
}

}  // namespace condyle::cli
