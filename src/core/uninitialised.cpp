#include "core/uninitialised.hpp"

#include <bit>
#include <new>

#include "core/spare_blocks.hpp"

#ifdef __linux__
#include <sys/mman.h>
#endif

#ifndef __has_feature
#define __has_feature(feature) 0
#endif

namespace condyle::core {
namespace {

constexpr std::size_t large_page = std::size_t{2} << 20;

/// For vectors of any instruction set, and a line of the cache.
constexpr std::size_t small_alignment = 64;

/// Blocks from here on are kept when they are freed. Smaller ones are a matter of the allocator.
constexpr std::size_t least_kept = std::size_t{16} << 10;

/// As much as GNU's allocator keeps by itself at most: room for the ring and the radial table of 156,288
/// triangles.
constexpr std::size_t most_kept = std::size_t{64} << 20;

/// Kept memory would hide from the sanitizer that it is used after it was freed.
#if defined(__SANITIZE_ADDRESS__) || __has_feature(address_sanitizer)
constexpr bool keeps_blocks = false;
#else
constexpr bool keeps_blocks = true;
#endif

constexpr std::align_val_t alignment_of(std::size_t bytes) noexcept {
  return std::align_val_t{bytes >= large_page ? large_page : small_alignment};
}

constexpr bool is_kept(std::size_t bytes) noexcept {
  return keeps_blocks && bytes >= least_kept;
}

/// Of few sizes, at most an eighth too large, so that tables of nearly the same size use each other's; what
/// is too much is never touched.
constexpr std::size_t size_of_block(std::size_t bytes) noexcept {
  if (!is_kept(bytes)) return bytes;
  const std::size_t step = std::bit_floor(bytes) / 8;
  return (bytes + step - 1) / step * step;
}

void release(void* memory, std::size_t bytes) noexcept {
  ::operator delete(memory, alignment_of(bytes));
}

/// Never destroyed: vectors may live until after all that is.
constinit SpareBlocks spare_blocks(most_kept, release);

}  // namespace

void* allocate_large(std::size_t wanted) {
  const std::size_t bytes = size_of_block(wanted);
  if (is_kept(wanted)) {
    if (void* const spare = spare_blocks.take(bytes)) return spare;
  }
  void* memory = ::operator new(bytes, alignment_of(bytes));
#ifdef __linux__
  // Advice: where it is not taken, pages are small and all else is as before.
  if (bytes >= large_page) ::madvise(memory, bytes, MADV_HUGEPAGE);
#endif
  return memory;
}

void free_large(void* memory, std::size_t wanted) noexcept {
  const std::size_t bytes = size_of_block(wanted);
  if (is_kept(wanted)) {
    spare_blocks.keep(memory, bytes);
  } else {
    release(memory, bytes);
  }
}

}  // namespace condyle::core
