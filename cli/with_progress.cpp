#include "with_progress.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <cstdio>
#include <cstdlib>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "interrupt.hpp"
#include "io/file/failure.hpp"
#include "io/file/temporary_folder.hpp"

namespace condyle::cli {
namespace {

using namespace std::chrono_literals;

constexpr auto between_polls = 20ms;
/// Long enough for most steps to end by themselves, short enough for somebody who waits.
constexpr auto patience = 500ms;

WholeProgress* whole = nullptr;  // the one there is

/// The stage that work is in, and how far it is. The work's threads write it, and the one that watches for signals reads it.
class Stage {
 public:
  explicit Stage(Writes writes)
      : kept_(writes == Writes::parts ? "the same command goes on from here" : "nothing is written") {}

  void update(std::string_view name, std::size_t done, std::size_t total) {
    const std::scoped_lock lock(mutex_);
    if (whole) {
      whole->update(name, done, total);
      name_ = name;
    } else {
      if (!progress_ || name_ != name) progress_.emplace(name_ = name);
      progress_->update(done, total);
    }
    done_ = done, total_ = total;
  }

  /// Ends it, and says where.
  std::string interrupted() {
    const std::scoped_lock lock(mutex_);
    progress_.reset();
    if (whole) whole->wipe();
    if (name_.empty()) return "interrupted; " + kept_;
    return fmt::format("interrupted after {} of {} {}; {}", done_, total_, name_, kept_);
  }

 private:
  std::mutex mutex_;
  std::optional<Progress> progress_;
  std::string name_, kept_;
  std::size_t done_ = 0, total_ = 0;
};

}  // namespace

WholeProgress::WholeProgress(std::string what, std::vector<std::vector<double>> pieces)
    : progress_(std::in_place, std::move(what)), pieces_(std::move(pieces)) {
  whole = this;
}

WholeProgress::~WholeProgress() {
  whole = nullptr;
}

void WholeProgress::end_piece() {
  ++piece_, stage_ = 0, done_ = 0, name_.clear();
}

void WholeProgress::update(std::string_view name, std::size_t done, std::size_t total) {
  // A name may come again: of limits, then of measures.
  if (!name_.empty() && (name != name_ || done < done_)) ++stage_;
  name_ = name, done_ = done;
  double before = 0, all = 0;
  for (std::size_t p = 0; p < pieces_.size(); ++p)
    for (std::size_t s = 0; s < pieces_[p].size(); ++s) {
      const bool is_now = p == piece_ && s == stage_;
      if (p < piece_ || (p == piece_ && s < stage_)) before += pieces_[p][s];
      if (is_now) before += pieces_[p][s] * static_cast<double>(done) / static_cast<double>(total);
      all += pieces_[p][s];
    }
  share_ = std::max(share_, before / all);
  if (progress_) progress_->update(share_);
}

void run_with_progress(const std::function<bool(const Control&)>& work, Writes writes) {
  const InterruptWatch watch;
  std::stop_source stop;
  Stage stage(writes);
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
  if (whole) whole->end_piece();
  // Work may end before it sees that it is to stop.
  if (!completed || (writes == Writes::nothing && watch.interrupted()))
    throw Interrupted(stage.interrupted());
}

}  // namespace condyle::cli
