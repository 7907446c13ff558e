#include "progress.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdio>

#include "standard_streams.hpp"

namespace condyle::cli {
namespace {

using namespace std::chrono_literals;

constexpr auto silence = 2s;
constexpr auto between_updates = 200ms;
constexpr auto between_lines = 10s;

/// To the first column, and everything to the right of it wiped (ECMA-48).
constexpr std::string_view wipe_line = "\r\x1b[K";

void show_on_standard_error(std::string_view text) {
  std::fwrite(text.data(), 1, text.size(), stderr);
  std::fflush(stderr);
}

}  // namespace

ProgressPlace standard_error_place() {
  return standard_error_is_terminal() ? ProgressPlace::terminal : ProgressPlace::log;
}

std::optional<double> remaining_seconds(double elapsed_s, std::size_t done, std::size_t total) {
  if (done == 0 || elapsed_s <= 0) return std::nullopt;
  return elapsed_s * (static_cast<double>(total - done) / static_cast<double>(done));
}

std::string duration_text(double seconds) {
  constexpr double minute = 60, hour = 3600;
  if (seconds < minute) return fmt::format("{:.0f} s", std::ceil(seconds));
  if (seconds < hour) return fmt::format("{:.0f} min", std::ceil(seconds / minute));
  const double minutes = std::ceil(seconds / minute);
  return fmt::format("{:.0f} h {:02.0f} min", std::floor(minutes / 60), std::fmod(minutes, 60));
}

Progress::Progress(std::string what)
    : Progress(std::move(what), standard_error_place(), Clock::now, show_on_standard_error) {}

Progress::Progress(std::string what, ProgressPlace place, Now now, Show show)
    : what_(std::move(what)),
      place_(place),
      now_(std::move(now)),
      show_(std::move(show)),
      start_(now_()),
      next_(start_ + silence) {}

Progress::~Progress() {
  if (shown_ && place_ == ProgressPlace::terminal) show_(wipe_line);
}

void Progress::update(std::size_t done, std::size_t total) {
  update(done, total,
         fmt::format("{} of {} ({:.0f} %)", done, total,
                     std::floor(100 * static_cast<double>(done) / static_cast<double>(total))));
}

void Progress::update(double share) {
  constexpr double whole = 1e6;
  update(static_cast<std::size_t>(whole * share), static_cast<std::size_t>(whole),
         fmt::format("{:.0f} %", std::floor(100 * share)));
}

void Progress::update(std::size_t done, std::size_t total, const std::string& words) {
  const auto now = now_();
  if (now < next_ || done == total) return;
  const double elapsed = std::chrono::duration<double>(now - start_).count();
  const auto left = remaining_seconds(elapsed, done, total);
  const std::string line =
      fmt::format("{}: {}{}", what_, words, left ? fmt::format(", about {} left", duration_text(*left)) : "");
  if (place_ == ProgressPlace::terminal) {
    show_(fmt::format("{}{}", wipe_line, line));
    next_ = now + between_updates;
  } else {
    show_(fmt::format("{}\n", line));
    next_ = now + between_lines;
  }
  shown_ = true;
}

}  // namespace condyle::cli
