#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "condyle/control.hpp"
#include "progress.hpp"

/// Long work of a command: its progress on standard error, and how SIGINT or SIGTERM stops it.

namespace condyle::cli {

/// One progress for several pieces of work after each other, while it lives: how much of all of them is done. Each piece has its stages,
/// with about how long each takes beside the others; one piece is what one with_progress() does.
class WholeProgress {
 public:
  WholeProgress(std::string what, std::vector<std::vector<double>> pieces);
  WholeProgress(const WholeProgress&) = delete;
  WholeProgress& operator=(const WholeProgress&) = delete;
  ~WholeProgress();

  void update(std::string_view stage, std::size_t done, std::size_t total);
  void end_piece();
  /// Shows no more.
  void wipe() { progress_.reset(); }

 private:
  std::optional<Progress> progress_;
  std::vector<std::vector<double>> pieces_;
  std::size_t piece_ = 0, stage_ = 0, done_ = 0;
  std::string name_;
  double share_ = 0;
};

/// Whether work writes its own files, at its end and whole or not at all: once they are there, a signal comes too late. `parts` are
/// files of which what is done is kept, and the same run goes on from there.
enum class Writes { nothing, files, parts };

/// Runs `work`, which answers whether it was completed, with a control that shows progress. SIGINT or SIGTERM stops it, and throws
/// Interrupted; work whose steps take longer than anybody waits is left: a second after the signal the process has ended with exit code
/// 130.
void run_with_progress(const std::function<bool(const Control&)>& work, Writes writes);

/// The answer of `compute`, an optional that is empty if it was stopped; as run_with_progress().
template <class Compute>
auto with_progress(const Compute& compute, Writes writes = Writes::nothing) {
  std::invoke_result_t<Compute, const Control&> answer;
  run_with_progress(
      [&](const Control& control) {
        answer = compute(control);
        return answer.has_value();
      },
      writes);
  return *std::move(answer);
}

}  // namespace condyle::cli
