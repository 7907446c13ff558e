#pragma once

#include <atomic>
#include <mutex>

#include "core/parallel.hpp"

namespace condyle::core {

/// A part of a value that is made when it is first read, by whichever thread comes first, and may be made
/// out of date. What it is made from belongs to its owner: copies of both go together.
template <class T>
class Lazy {
 public:
  Lazy() = default;
  Lazy(const Lazy& other) : Lazy(other, std::lock_guard(other.mutex_)) {}
  /// While nothing else reads this one.
  Lazy& operator=(const Lazy& other) {
    if (this == &other) return *this;
    const std::lock_guard lock(other.mutex_);
    value_ = other.value_;
    is_current_.store(other.is_current_.load(std::memory_order_relaxed), std::memory_order_relaxed);
    return *this;
  }

  /// make(T&) where it is not current, once for all threads; the rest wait. Where it throws, the part stays as
  /// out of date as it was. What it computes in parallel takes up no work from outside, which may want this part.
  template <class Make>
  const T& get(const Make& make) const {
    if (is_current_.load(std::memory_order_acquire)) return value_;
    const std::lock_guard lock(mutex_);
    if (!is_current_.load(std::memory_order_relaxed)) {
      isolated([&] { make(value_); });
      is_current_.store(true, std::memory_order_release);
    }
    return value_;
  }

  [[nodiscard]] bool is_current() const noexcept { return is_current_.load(std::memory_order_acquire); }
  /// To be kept current by hand while nothing else reads it; null if it is out of date.
  T* current() noexcept { return is_current_.load(std::memory_order_relaxed) ? &value_ : nullptr; }
  /// Its memory is kept for when it is made again.
  void make_out_of_date() noexcept { is_current_.store(false, std::memory_order_relaxed); }
  /// As it was last made, current or not.
  const T& last() const noexcept { return value_; }

 private:
  Lazy(const Lazy& other, const std::lock_guard<std::mutex>&)
      : value_(other.value_), is_current_(other.is_current_.load(std::memory_order_relaxed)) {}

  mutable T value_{};
  mutable std::mutex mutex_;
  mutable std::atomic<bool> is_current_ = false;
};

}  // namespace condyle::core
