#pragma once

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <cstddef>

#include "core/sanitizer_order.hpp"

namespace condyle::core {

/// Calls body(i) for every i of [0, count), begun in ascending order, by threads that each take the next one when they are done
/// with theirs. What a body computes in parallel itself stays within its share of the threads: nested loops of one task then
/// never wait while they work at another one, and memory is that of as many tasks as there are threads. A body writes to its
/// own elements and does not throw.
template <class Body>
void parallel_tasks(std::size_t count, const Body& body) {
  if (count == 0) return;
  const std::size_t allowed = tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
  const std::size_t threads =
      std::min(allowed, static_cast<std::size_t>(tbb::this_task_arena::max_concurrency()));
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
}

}  // namespace condyle::core
