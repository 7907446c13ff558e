#include "with_progress.hpp"

#include <chrono>
#include <condition_variable>
#include <cstdio>
#include <cstdlib>
#include <mutex>
#include <stop_token>
#include <thread>

#include "interrupt.hpp"
#include "io/file/failure.hpp"
#include "io/file/temporary_folder.hpp"
#include "work_stage.hpp"

namespace condyle::cli {
namespace {

using namespace std::chrono_literals;

constexpr auto between_polls = 20ms;
/// Long enough for most steps to end by themselves, short enough for somebody who waits.
constexpr auto patience = 500ms;

}  // namespace

void run_with_progress(const std::function<bool(const Control&)>& work, Writes writes) {
  const InterruptWatch watch;
  std::stop_source stop;
  WorkStage stage(writes);
  const std::jthread watcher([&](const std::stop_token& ended) {
    std::mutex mutex;
    std::condition_variable_any polls;
    /// False as soon as the work has ended: nobody waits for a poll.
    const auto next_poll = [&] {
      std::unique_lock lock(mutex);
      polls.wait_for(lock, ended, between_polls, [] { return false; });
      return !ended.stop_requested();
    };
    while (!watch.interrupted())
      if (!next_poll()) return;
    stop.request_stop();
    // A file that is being written is complete within moments.
    for (auto waited = 0ms; waited < patience || io::temporary_folders_live(); waited += between_polls)
      if (!next_poll()) return;
    io::end_temporary_folders();
    std::fprintf(stderr, "condyle: %s\n", stage.interrupted().c_str());
    std::_Exit(io::interrupted);
  });
  const auto report = [&](std::string_view name, std::size_t done, std::size_t total) {
    stage.update(name, done, total);
  };
  const bool completed = work({report, stop.get_token()});
  WorkStage::end_piece();
  // Work may end before it sees that it is to stop.
  if (!completed || (writes == Writes::nothing && watch.interrupted()))
    throw Interrupted(stage.interrupted());
}

}  // namespace condyle::cli
