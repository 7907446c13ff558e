#include "core/uninitialised.hpp"

#include <new>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace condyle::core {
namespace {

#ifdef __linux__
constexpr bool has_large_pages = true;
#else
constexpr bool has_large_pages = false;
#endif

constexpr std::size_t large_page = std::size_t{2} << 20;

/// For vectors of any instruction set, and a line of the cache.
constexpr std::size_t small_alignment = 64;

/// What fills half of a large page has one.
constexpr bool is_large(std::size_t bytes) noexcept {
  return has_large_pages && bytes >= large_page / 2;
}

constexpr std::align_val_t alignment_of(std::size_t bytes) noexcept {
  return std::align_val_t{is_large(bytes) ? large_page : small_alignment};
}

}  // namespace

void* allocate_large(std::size_t bytes) {
  void* memory = ::operator new(bytes, alignment_of(bytes));
#ifdef __linux__
  // Advice, for the whole of the last page too: where it is not taken, pages are small and all else is as before.
  if (is_large(bytes)) ::madvise(memory, (bytes + large_page - 1) / large_page * large_page, MADV_HUGEPAGE);
#endif
  return memory;
}

void free_large(void* memory, std::size_t bytes) noexcept {
  ::operator delete(memory, alignment_of(bytes));
}

}  // namespace condyle::core
