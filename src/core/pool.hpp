#pragma once

#include <atomic>
#include <memory>

namespace condyle::core {

/// Keeps one object between its uses, so that scratch is allocated once. Any number of threads: a thread that takes
/// from an empty pool makes an object, and of two that are put back one is deleted. A copy starts empty.
template <class T>
class Pool {
 public:
  Pool() = default;
  Pool(const Pool&) noexcept {}
  Pool& operator=(const Pool&) noexcept { return *this; }
  ~Pool() { delete kept_.load(std::memory_order_relaxed); }

  /// The one kept, as it was left, or a new one without values.
  std::unique_ptr<T> take() {
    T* const kept = kept_.exchange(nullptr, std::memory_order_acquire);
    return kept ? std::unique_ptr<T>(kept) : std::make_unique_for_overwrite<T>();
  }
  void put_back(std::unique_ptr<T> object) noexcept {
    delete kept_.exchange(object.release(), std::memory_order_acq_rel);
  }

 private:
  std::atomic<T*> kept_ = nullptr;
};

}  // namespace condyle::core
