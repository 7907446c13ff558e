#pragma once

#include <mutex>
#include <optional>

namespace condyle::core {

/// A value that is made when it is first needed, by whichever thread comes first; others wait for it. Where
/// making it raises, the next one to ask tries again.
template <class T>
class Lazy {
 public:
  template <class Make>
  const T& get(const Make& make) const {
    std::call_once(once_, [&] { value_.emplace(make()); });
    return *value_;
  }

 private:
  mutable std::once_flag once_;
  mutable std::optional<T> value_;
};

}  // namespace condyle::core
