#pragma once

#include <cstddef>

#if defined(CONDYLE_THREADS_STD)
#include "core/thread_pool.hpp"
#elif !defined(CONDYLE_THREADS_NONE)
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>
#include <tbb/task_arena.h>

#include <exception>

#include "core/sanitizer_order.hpp"
#endif

namespace condyle::core {

/// Calls body(first, last) over [0, count) in chunks, on all threads of the calling oneTBB arena or of our own pool, as
/// CONDYLE_THREADS was when it was built; built without threads, once for all. A body writes only to its own elements: results then
/// do not depend on the number of threads. Limit threads with core::ThreadLimit, and oneTBB's also from outside with
/// tbb::global_control or tbb::task_arena.
template <class Body>
void parallel_chunks(std::size_t count, [[maybe_unused]] std::size_t grain, const Body& body) {
#if defined(CONDYLE_THREADS_NONE)
  if (count > 0) body(std::size_t{0}, count);
#elif defined(CONDYLE_THREADS_STD)
  pool::parallel_chunks(count, grain, body);
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

/// Calls it so that a thread that waits for what it computes in parallel takes up nothing from outside. Our own pool never does.
template <class Body>
void isolated(const Body& body) {
#if defined(CONDYLE_THREADS_NONE) || defined(CONDYLE_THREADS_STD)
  body();
#else
  tbb::this_task_arena::isolate(body);
#endif
}

/// Calls both, at the same time if there are threads. A thread that waits for what one of them computes in parallel itself never
/// takes up the other, which may want a part of a mesh (core::Lazy) that the thread is making. If both throw, the first one's
/// exception is thrown.
template <class First, class Second>
void parallel_pair(const First& first, const Second& second) {
#if defined(CONDYLE_THREADS_NONE)
  first();
  second();
#elif defined(CONDYLE_THREADS_STD)
  pool::parallel_pair(first, second);
#else
  std::exception_ptr first_error, second_error;
  SanitizerOrder begun, done;
  const auto run = [&](const auto& body, std::exception_ptr& error) {
    begun.after();
    try {
      isolated(body);
    } catch (...) {
      error = std::current_exception();
    }
    done.before();
  };
  begun.before();
  isolated(
      [&] { tbb::parallel_invoke([&] { run(first, first_error); }, [&] { run(second, second_error); }); });
  done.after();
  for (const std::exception_ptr& error : {first_error, second_error})
    if (error) std::rethrow_exception(error);
#endif
}

}  // namespace condyle::core
