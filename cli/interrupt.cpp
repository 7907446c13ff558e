#include "interrupt.hpp"

#include <atomic>

namespace condyle::cli {
namespace {

std::atomic<bool> signalled = false;
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may use no other");

void note(int) {
  signalled = true;
}

}  // namespace

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
