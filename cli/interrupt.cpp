#include "interrupt.hpp"

#include <array>
#include <atomic>
#include <csignal>
#include <cstdlib>

#include "io/file/temporary_folder.hpp"
#include "standard_streams.hpp"

namespace condyle::cli {
namespace {

std::atomic<bool> signalled = false;
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may use no other");

constexpr int exit_code = 130;

constexpr std::array<int, 3> signals = {SIGINT, SIGTERM, SIGHUP};

/// What was done at each of them before the one watch that lives.
std::array<struct sigaction, signals.size()> before_watch;

/// Only what a signal handler may call.
void end(int) {
  write_to_standard_error("condyle: interrupted; nothing more is written\n");
  io::end_temporary_folders();
  std::_Exit(exit_code);
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
  for (const int other : signals) ::sigaddset(&action.sa_mask, other);
  ::sigaction(signal, &action, nullptr);
}

}  // namespace

void say_when_interrupted() noexcept {
  for (const int signal : signals) handle(signal, end, nullptr);
  std::signal(SIGXFSZ, SIG_IGN);
}

InterruptWatch::InterruptWatch() {
  signalled = false;
  for (std::size_t i = 0; i < signals.size(); ++i) handle(signals[i], note_signal, &before_watch[i]);
}

InterruptWatch::~InterruptWatch() {
  for (std::size_t i = 0; i < signals.size(); ++i) ::sigaction(signals[i], &before_watch[i], nullptr);
}

bool InterruptWatch::interrupted() const noexcept {
  return signalled;
}

}  // namespace condyle::cli
