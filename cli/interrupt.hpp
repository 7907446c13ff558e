#pragma once

#include <csignal>
#include <stdexcept>

namespace condyle::cli {

/// Work was stopped from outside before it was done. The message is one line.
class Interrupted : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// While it lives, the first SIGINT or SIGTERM is noted instead of ending the process, so that it can end with
/// nothing half-written; a second one ends it as ever. One at a time.
class InterruptWatch {
 public:
  InterruptWatch();
  ~InterruptWatch();
  InterruptWatch(const InterruptWatch&) = delete;
  InterruptWatch& operator=(const InterruptWatch&) = delete;

  bool interrupted() const noexcept;

 private:
  struct sigaction old_int_, old_term_;
};

}  // namespace condyle::cli
