#include "interrupt.hpp"

/// As cli/interrupt.cpp, with node's main thread in place of signal handlers: npm/command.mjs. Functions of glue.js.

extern "C" {
int condyle_signalled();
void condyle_watch(int begins);
}

namespace condyle::cli {

void say_when_interrupted() noexcept {}

InterruptWatch::InterruptWatch() {
  condyle_watch(1);
}

InterruptWatch::~InterruptWatch() {
  condyle_watch(0);
}

bool InterruptWatch::interrupted() const noexcept {
  return condyle_signalled() != 0;
}

}  // namespace condyle::cli
