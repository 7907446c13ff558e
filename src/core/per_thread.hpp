#pragma once

#ifdef CONDYLE_SERIAL
#include <functional>
#include <optional>
#else
#include <tbb/enumerable_thread_specific.h>
#endif

namespace condyle::core {

/// A value for each thread that asks for its own, made when it first does by the function given. Built without threads there
/// is one.
#ifdef CONDYLE_SERIAL
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
#else
template <class T>
using PerThread = tbb::enumerable_thread_specific<T>;
#endif

}  // namespace condyle::core
