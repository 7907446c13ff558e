#pragma once

#if defined(CONDYLE_THREADS_NONE)
#include <functional>
#include <optional>
#elif defined(CONDYLE_THREADS_STD)
#include "core/thread_pool.hpp"
#else
#include <tbb/enumerable_thread_specific.h>
#endif

namespace condyle::core {

/// A value for each thread that asks for its own, made when it first does by the function given. Built without threads there
/// is one.
#if defined(CONDYLE_THREADS_NONE)
template <class T>
class PerThread {
 public:
  explicit PerThread(std::function<T()> make) : make_(std::move(make)) {}

  T& local() {
    if (!value_) value_.emplace(make_());
    return *value_;
  }

 private:
  std::function<T()> make_;
  std::optional<T> value_;
};
#elif defined(CONDYLE_THREADS_STD)
using pool::PerThread;
#else
template <class T>
using PerThread = tbb::enumerable_thread_specific<T>;
#endif

}  // namespace condyle::core
