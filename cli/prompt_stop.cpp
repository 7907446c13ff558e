#include "prompt_stop.hpp"

#include <fmt/format.h>

#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <thread>
#include <utility>

#include "interrupt.hpp"
#include "io/file/failure.hpp"
#include "io/file/temporary_folder.hpp"
#include "progress.hpp"

namespace condyle::cli {
namespace {

using namespace std::chrono_literals;

constexpr auto between_polls = 20ms;
/// Long enough for most steps to end by themselves, short enough for somebody who waits.
constexpr auto patience = 500ms;

std::string words_for(std::size_t done, std::size_t total, const char* what) {
  return fmt::format("interrupted after {} of {} {}; nothing is written", done, total, what);
}

}  // namespace

io::StudyDone stopped_promptly(
    const char* what,
    const std::function<std::optional<io::StudyDone>(const std::function<void(std::size_t, std::size_t)>&,
                                                     std::stop_token)>& compute) {
  const InterruptWatch watch;
  std::stop_source stop;
  Progress progress(what);
  std::atomic<std::size_t> done = 0, total = 0;
  const std::jthread watcher([&](std::stop_token ended) {
    while (!ended.stop_requested() && !watch.interrupted()) std::this_thread::sleep_for(between_polls);
    if (ended.stop_requested()) return;
    stop.request_stop();
    // A file that is being written is complete within moments.
    for (auto waited = 0ms; waited < patience || io::temporary_folders_live(); waited += between_polls) {
      if (ended.stop_requested()) return;
      std::this_thread::sleep_for(between_polls);
    }
    io::end_temporary_folders();
    std::fprintf(stderr, "condyle: %s\n", words_for(done, total, what).c_str());
    std::_Exit(io::interrupted);
  });
  auto answer = compute(
      [&](std::size_t now_done, std::size_t of) {
        done = now_done, total = of;
        progress.update(now_done, of);
      },
      stop.get_token());
  if (!answer) throw Interrupted(words_for(done, total, what));
  return std::move(*answer);
}

}  // namespace condyle::cli
