#include "fuzz/largest_allocation.hpp"

#include <cstdlib>
#include <new>

namespace condyle::test {

std::atomic<std::size_t> largest_allocation = 0;

}  // namespace condyle::test

// The array forms come here by default. In a file of their own: where the compiler sees a body, it takes
// malloc for a mismatch of delete.
void* operator new(std::size_t size) {
  using condyle::test::largest_allocation;
  std::size_t largest = largest_allocation.load(std::memory_order_relaxed);
  while (size > largest &&
         !largest_allocation.compare_exchange_weak(largest, size, std::memory_order_relaxed)) {
  }
  if (void* memory = std::malloc(size == 0 ? 1 : size)) return memory;
  throw std::bad_alloc();
}
/// std::stable_sort asks so for its buffer, and gives it back to the delete below.
void* operator new(std::size_t bytes, const std::nothrow_t&) noexcept {
  try {
    return operator new(bytes);
  } catch (const std::bad_alloc&) {
    return nullptr;
  }
}
void operator delete(void* memory) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}
