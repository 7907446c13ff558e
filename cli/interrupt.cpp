#include "interrupt.hpp"

#include <unistd.h>

#include <atomic>
#include <string_view>

namespace condyle::cli {
namespace {

std::atomic<bool> signalled = false;
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may use no other");

void note(int) {
  signalled = true;
}

constexpr int exit_code = 130;

/// Only what a signal handler may call.
void end(int) {
  constexpr std::string_view line = "condyle: interrupted; nothing more is written\n";
  [[maybe_unused]] const auto written = ::write(STDERR_FILENO, line.data(), line.size());
  ::_exit(exit_code);
}

}  // namespace

void say_when_interrupted() noexcept {
  for (const int signal : {SIGINT, SIGTERM}) {
    struct sigaction action {};
    ::sigaction(signal, nullptr, &action);
    if (action.sa_handler == SIG_IGN) continue;
    action = {};
    action.sa_handler = end;
    ::sigaction(signal, &action, nullptr);
  }
  std::signal(SIGXFSZ, SIG_IGN);
}

InterruptWatch::InterruptWatch() {
  signalled = false;
  struct sigaction action {};
  action.sa_handler = note;
  action.sa_flags = SA_RESETHAND | SA_RESTART;
  ::sigaction(SIGINT, &action, &old_int_);
  ::sigaction(SIGTERM, &action, &old_term_);
}

InterruptWatch::~InterruptWatch() {
  ::sigaction(SIGINT, &old_int_, nullptr);
  ::sigaction(SIGTERM, &old_term_, nullptr);
}

bool InterruptWatch::interrupted() const noexcept {
  return signalled;
}

}  // namespace condyle::cli
