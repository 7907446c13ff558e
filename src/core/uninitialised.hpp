#pragma once

#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

namespace condyle::core {

/// Memory for large arrays that are read here and there: from 1 MB on in large pages where the system has
/// them. A table of 10 MB lies on 2500 small pages, more than a processor keeps the addresses of: finding a
/// page then takes as long as reading from it (a query of 150000 triangles took 1.5 times as long).
void* allocate_large(std::size_t bytes);
void free_large(void* memory, std::size_t bytes) noexcept;

/// An allocator whose elements start without a value: for arrays that are written whole right after they are
/// made, where zeros first would cost as much as the writing.
template <class T>
struct UninitialisedAllocator {
  using value_type = T;

  UninitialisedAllocator() = default;
  template <class U>
  UninitialisedAllocator(const UninitialisedAllocator<U>&) noexcept {}

  T* allocate(std::size_t count) { return static_cast<T*>(allocate_large(count * sizeof(T))); }
  void deallocate(T* memory, std::size_t count) noexcept { free_large(memory, count * sizeof(T)); }
  template <class U>
  void construct(U*) noexcept {}
  template <class U, class... Arguments>
  void construct(U* at, Arguments&&... arguments) {
    std::construct_at(at, std::forward<Arguments>(arguments)...);
  }
  friend bool operator==(const UninitialisedAllocator&, const UninitialisedAllocator&) noexcept {
    return true;
  }
};

/// A vector of plain values; resize() leaves new elements without a value.
template <class T>
using UninitialisedVector = std::vector<T, UninitialisedAllocator<T>>;

}  // namespace condyle::core
