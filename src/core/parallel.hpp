#pragma once

#include <cstddef>

#ifndef CONDYLE_SERIAL
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "core/sanitizer_order.hpp"
#endif

namespace condyle::core {

/// Calls body(first, last) over [0, count) in chunks, on all threads of the calling oneTBB arena; built without threads, once
/// for all. A body writes only to its own elements: results then do not depend on the number of threads. Limit threads from
/// outside with tbb::global_control or tbb::task_arena.
template <class Body>
void parallel_chunks(std::size_t count, [[maybe_unused]] std::size_t grain, const Body& body) {
#ifdef CONDYLE_SERIAL
  if (count > 0) body(std::size_t{0}, count);
#else
  SanitizerOrder begun, done;
  begun.before();
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, grain),
                    [&](const tbb::blocked_range<std::size_t>& range) {
                      begun.after();
                      body(range.begin(), range.end());
                      done.before();
                    });
  done.after();
#endif
}

}  // namespace condyle::core
