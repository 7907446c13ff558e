#include "with_progress.hpp"

#include <fmt/format.h>

#include <optional>
#include <stop_token>
#include <string>

#include "interrupt.hpp"
#include "progress.hpp"

/// As cli/with_progress.cpp, by one thread: a signal is seen where work says how far it is.

namespace condyle::cli {

void run_with_progress(const std::function<bool(const Control&)>& work, Writes writes) {
  const InterruptWatch watch;
  std::stop_source stop;
  std::optional<Progress> progress;
  std::string stage;
  std::size_t stage_done = 0, stage_total = 0;
  const auto report = [&](std::string_view name, std::size_t done, std::size_t total) {
    if (!progress || stage != name) progress.emplace(stage = name);
    stage_done = done, stage_total = total;
    progress->update(done, total);
    if (watch.interrupted()) stop.request_stop();
  };
  const bool completed = work({report, stop.get_token()});
  progress.reset();
  if (completed && (writes == Writes::files || !watch.interrupted())) return;
  throw Interrupted(stage.empty() ? "interrupted; nothing is written"
                                  : fmt::format("interrupted after {} of {} {}; nothing is written",
                                                stage_done, stage_total, stage));
}

}  // namespace condyle::cli
