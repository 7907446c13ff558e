#pragma once

#include <stdexcept>

namespace condyle::cli {

/// Work was stopped from outside before it was done. The message is one line.
class Interrupted : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// From now on SIGINT, SIGTERM or SIGHUP ends the process at once with one line and exit code 130, and nothing half-written
/// is left; not one that the parent had it ignore, as nohup and shells in the background do. A
/// file that would grow past what the process may write is an error of writing like a full disk, and no signal.
void say_when_interrupted() noexcept;

/// During its lifetime, the first of these signals is noted instead of ending the process, so that it can end with no
/// half-written file; a second one ends it as ever. One at a time.
class InterruptWatch {
 public:
  InterruptWatch();
  ~InterruptWatch();
  InterruptWatch(const InterruptWatch&) = delete;
  InterruptWatch& operator=(const InterruptWatch&) = delete;

  bool interrupted() const noexcept;
};

}  // namespace condyle::cli
