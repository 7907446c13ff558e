#include "with_progress.hpp"

#include <stop_token>

#include "interrupt.hpp"
#include "work_stage.hpp"

/// As cli/with_progress.cpp, by one thread: a signal is seen where work says how far it is.

namespace condyle::cli {

void run_with_progress(const std::function<bool(const Control&)>& work, Writes writes) {
  const InterruptWatch watch;
  std::stop_source stop;
  WorkStage stage(writes);
  const auto report = [&](std::string_view name, std::size_t done, std::size_t total) {
    stage.update(name, done, total);
    if (watch.interrupted()) stop.request_stop();
  };
  const bool completed = work({report, stop.get_token()});
  WorkStage::end_piece();
  if (!completed || (writes == Writes::nothing && watch.interrupted()))
    throw Interrupted(stage.interrupted());
}

}  // namespace condyle::cli
