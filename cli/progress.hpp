#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

/// How far a long computation is, on standard error. Short ones say nothing.

namespace condyle::cli {

/// Where progress is shown: a terminal has one line that is written over, anything else gets a line now and
/// then.
enum class ProgressPlace { terminal, log };

/// The kind of standard error.
ProgressPlace standard_error_place();

/// Seconds still to go at the pace since the start; nothing if there is no pace yet.
std::optional<double> remaining_seconds(double elapsed_s, std::size_t done, std::size_t total);

/// "40 s", "12 min", "3 h 05 min": at the precision of an estimate.
std::string duration_text(double seconds);

/// Decides what to show and when: nothing for the first two seconds, then at most five times a second on a
/// terminal, and every ten seconds in a log.
class Progress {
 public:
  using Clock = std::chrono::steady_clock;
  using Now = std::function<Clock::time_point()>;
  using Show = std::function<void(std::string_view)>;

  /// Shows on standard error.
  explicit Progress(std::string what);
  /// Shows elsewhere, by another clock.
  Progress(std::string what, ProgressPlace place, Now now, Show show);
  /// Wipes the line on a terminal.
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void update(std::size_t done, std::size_t total);
  /// `share` is that of all the work, 0 to 1.
  void update(double share);

 private:
  void update(std::size_t done, std::size_t total, const std::string& words);

  std::string what_;
  ProgressPlace place_;
  Now now_;
  Show show_;
  Clock::time_point start_, next_;
  bool shown_ = false;
};

}  // namespace condyle::cli
