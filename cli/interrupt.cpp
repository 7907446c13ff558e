#include "interrupt.hpp"

#include <unistd.h>

#include <atomic>
#include <string_view>

#include "io/file/temporary_folder.hpp"

namespace condyle::cli {
namespace {

std::atomic<bool> signalled = false;
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may use no other");

constexpr int exit_code = 130;

/// Only what a signal handler may call.
void end(int) {
  constexpr std::string_view line = "condyle: interrupted; nothing more is written\n";
  [[maybe_unused]] const auto written = ::write(STDERR_FILENO, line.data(), line.size());
  io::end_temporary_folders();
  ::_exit(exit_code);
}

/// The second one ends the process.
void note_signal(int signal) {
  if (signalled.exchange(true)) end(signal);
}

/// Handler of a signal from now on, unless the parent had it ignored (nohup; a shell's background).
void handle(int signal, void (*handler)(int), struct sigaction* before) noexcept {
  struct sigaction now {};
  ::sigaction(signal, nullptr, &now);
  if (before != nullptr) *before = now;
  if (now.sa_handler == SIG_IGN) return;
  struct sigaction action {};
  action.sa_handler = handler;
  action.sa_flags = SA_RESTART;
  // The handler of one is not interrupted by another.
  for (const int other : InterruptWatch::signals) ::sigaddset(&action.sa_mask, other);
  ::sigaction(signal, &action, nullptr);
}

}  // namespace

void say_when_interrupted() noexcept {
  for (const int signal : InterruptWatch::signals) handle(signal, end, nullptr);
  std::signal(SIGXFSZ, SIG_IGN);
}

InterruptWatch::InterruptWatch() {
  signalled = false;
  for (std::size_t i = 0; i < signals.size(); ++i) handle(signals[i], note_signal, &before_[i]);
}

InterruptWatch::~InterruptWatch() {
  for (std::size_t i = 0; i < signals.size(); ++i) ::sigaction(signals[i], &before_[i], nullptr);
}

bool InterruptWatch::interrupted() const noexcept {
  return signalled;
}

}  // namespace condyle::cli
