#pragma once

#include <pybind11/pybind11.h>

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <exception>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string_view>
#include <thread>
#include <type_traits>

#include "condyle/control.hpp"

/// Ctrl-C and progress while the library works without the interpreter's lock.

namespace condyle::python {

namespace py = pybind11;

/// Interval between two checks for Ctrl-C: well below what people notice, well above what taking the lock costs.
inline constexpr std::chrono::milliseconds poll_interval{50};

/// For loops over short pieces of work on the calling thread, which does not hold the lock. Raises KeyboardInterrupt, or what
/// the callback raised.
class Follower {
 public:
  /// `progress` is a callable of (done, total), or None. Made while the lock is held.
  Follower(py::object progress, std::size_t total) : progress_(std::move(progress)), total_(total) {}

  /// After `done` pieces.
  void poll(std::size_t done) {
    const auto now = std::chrono::steady_clock::now();
    if (now - last_ < poll_interval && (done < total_ || progress_.is_none())) return;
    last_ = now;
    const py::gil_scoped_acquire held;
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    if (!progress_.is_none()) progress_(done, total_);
  }

 private:
  py::object progress_;
  std::size_t total_;
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

/// Result of `compute(control)`, computed on a thread of its own while this one watches for Ctrl-C and passes on progress, whatever the
/// stage. Called with the lock held. An answer that was stopped is never seen: the exception that stopped it is raised, once the
/// computation has ended.
template <class Compute>
auto with_progress(const py::object& progress, const Compute& compute) {
  using Answer = std::invoke_result_t<Compute, const Control&>;
  struct State {
    std::mutex mutex;
    std::condition_variable changed;
    std::size_t done = 0, total = 0;
    bool ended = false;
    std::optional<Answer> answer;
    std::exception_ptr error;
  } state;

  std::jthread worker([&](const std::stop_token& stop) {
    try {
      state.answer.emplace(compute(Control{[&](std::string_view, std::size_t done, std::size_t total) {
                                             const std::scoped_lock lock(state.mutex);
                                             state.done = done, state.total = total;
                                           },
                                           stop}));
    } catch (...) {
      state.error = std::current_exception();
    }
    const std::scoped_lock lock(state.mutex);
    state.ended = true;
    state.changed.notify_one();
  });

  std::exception_ptr stopped_by;
  std::size_t reported = 0;
  for (bool ended = false; !ended;) {
    std::size_t done = 0, total = 0;
    {
      const py::gil_scoped_release released;
      std::unique_lock lock(state.mutex);
      state.changed.wait_for(lock, poll_interval, [&] { return state.ended; });
      ended = state.ended, done = state.done, total = state.total;
    }
    if (stopped_by) continue;
    try {
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
      if (!progress.is_none() && done > reported) progress(done, total);
      reported = done;
    } catch (...) {
      stopped_by = std::current_exception();
      worker.request_stop();
    }
  }
  worker.join();
  if (stopped_by) std::rethrow_exception(stopped_by);
  if (state.error) std::rethrow_exception(state.error);
  return std::move(*state.answer);
}

}  // namespace condyle::python
