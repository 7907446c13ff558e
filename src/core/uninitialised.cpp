#include "core/uninitialised.hpp"

#include <new>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace condyle::core {
namespace {

constexpr std::size_t large_page = std::size_t{2} << 20;

/// For vectors of any instruction set, and a line of the cache.
constexpr std::size_t small_alignment = 64;

constexpr std::align_val_t alignment_of(std::size_t bytes) noexcept {
  return std::align_val_t{bytes >= large_page ? large_page : small_alignment};
}

}  // namespace

void* allocate_large(std::size_t bytes) {
  void* memory = ::operator new(bytes, alignment_of(bytes));
#ifdef __linux__
  // Advice: where it is not taken, pages are small and all else is as before.
  if (bytes >= large_page) ::madvise(memory, bytes, MADV_HUGEPAGE);
#endif
  return memory;
}

void free_large(void* memory, std::size_t bytes) noexcept {
  ::operator delete(memory, alignment_of(bytes));
}

}  // namespace condyle::core
