#pragma once

#include <cstddef>

#if defined(CONDYLE_THREADS_STD)
#include "core/thread_pool.hpp"
#elif !defined(CONDYLE_THREADS_NONE)
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <algorithm>
#endif

namespace condyle::core {

#if defined(CONDYLE_THREADS_STD)
using pool::ThreadLimit;
using pool::threads_allowed;
#else

/// While it lives, loops use at most so many threads, and of several limits the least one.
class ThreadLimit {
 public:
#if defined(CONDYLE_THREADS_NONE)
  explicit ThreadLimit(std::size_t) noexcept {}
#else
  explicit ThreadLimit(std::size_t threads)
      : control_(tbb::global_control::max_allowed_parallelism, threads) {}

 private:
  tbb::global_control control_;
#endif
};

/// How many threads a loop called here may use.
[[nodiscard]] inline std::size_t threads_allowed() {
#if defined(CONDYLE_THREADS_NONE)
  return 1;
#else
  return std::min(tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism),
                  static_cast<std::size_t>(tbb::this_task_arena::max_concurrency()));
#endif
}
#endif

}  // namespace condyle::core
