#pragma once

#include <memory>
#include <utility>
#include <vector>

namespace condyle {

/// An allocator whose elements start without a value: for arrays that are written whole right after they are
/// made, where zeros first would cost as much as the writing.
template <class T>
struct UninitialisedAllocator : std::allocator<T> {
  template <class U>
  struct rebind {
    using other = UninitialisedAllocator<U>;
  };
  template <class U>
  void construct(U*) noexcept {}
  template <class U, class... Arguments>
  void construct(U* at, Arguments&&... arguments) {
    std::construct_at(at, std::forward<Arguments>(arguments)...);
  }
};

/// A vector of plain values; resize() leaves new elements without a value.
template <class T>
using UninitialisedVector = std::vector<T, UninitialisedAllocator<T>>;

}  // namespace condyle
