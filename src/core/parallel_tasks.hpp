#pragma once

#include <cstddef>

#if defined(CONDYLE_THREADS_STD)
#include "core/thread_pool.hpp"
#elif !defined(CONDYLE_THREADS_NONE)
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>

#include "core/sanitizer_order.hpp"
#include "core/thread_limit.hpp"
#endif

namespace condyle::core {

/// Calls body(i) for every i of [0, count), begun in ascending order, by threads that each take the next one when they are done
/// with theirs. What a body computes in parallel itself stays within its share of the threads: nested loops of one task then
/// never wait while they work at another one, and memory is that of as many tasks as there are threads. A body writes to its
/// own elements and does not throw.
template <class Body>
void parallel_tasks(std::size_t count, const Body& body) {
#if defined(CONDYLE_THREADS_NONE)
  for (std::size_t i = 0; i < count; ++i) body(i);
#elif defined(CONDYLE_THREADS_STD)
  pool::parallel_tasks(count, body);
#else
  if (count == 0) return;
  const std::size_t threads = threads_allowed();
  const std::size_t workers = std::min(count, threads);
  std::atomic<std::size_t> next = 0;
  SanitizerOrder begun, done;
  begun.before();
  // A range each for as many as there are workers.
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(0, workers),
      [&](const tbb::blocked_range<std::size_t>&) {
        begun.after();
        tbb::task_arena share(static_cast<int>(threads / workers));
        for (std::size_t i = next++; i < count; i = next++) share.execute([&] { body(i); });
        done.before();
      },
      tbb::simple_partitioner());
  done.after();
#endif
}

}  // namespace condyle::core
