#pragma once

#include <atomic>
#include <memory>

namespace condyle::core {

/// Keeps one object between its uses, so that what is needed again and again is allocated once. Any number of
/// threads: whoever finds nothing kept makes one, and of two that are put back one goes. A copy starts without.
template <class T>
class Spare {
 public:
  Spare() = default;
  Spare(const Spare&) noexcept {}
  Spare& operator=(const Spare&) noexcept { return *this; }
  ~Spare() { delete kept_.load(std::memory_order_relaxed); }

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
