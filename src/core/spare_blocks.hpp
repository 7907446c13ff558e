#pragma once

#include <array>
#include <cstddef>
#include <mutex>

namespace condyle::core {

/// Blocks of memory that are no longer in use, kept for whoever asks for as many bytes again. Where large
/// blocks go back to the system at once, it clears their pages anew for the next table: a third of the time
/// that a ring table of 39,072 or 156,288 triangles takes.
///
/// Bounded: those that have waited longest go back first. For any number of threads.
class SpareBlocks {
 public:
  using Release = void (*)(void* memory, std::size_t bytes) noexcept;

  constexpr SpareBlocks(std::size_t most_bytes, Release release) noexcept
      : most_bytes_(most_bytes), release_(release) {}

  /// A block of exactly so many bytes, the one that has waited least; null where there is none.
  void* take(std::size_t bytes) noexcept;
  /// Keeps the block; releases it, or others, where that would be more than the bound.
  void keep(void* memory, std::size_t bytes) noexcept;

  static constexpr std::size_t most_blocks = 256;

 private:
  struct Block {
    void* memory = nullptr;
    std::size_t bytes = 0;
  };

  Block remove(std::size_t place) noexcept;

  std::size_t most_bytes_;
  Release release_;
  std::mutex mutex_;
  std::array<Block, most_blocks> block_{};  ///< In the order in which they came.
  std::size_t count_ = 0, bytes_ = 0;
};

}  // namespace condyle::core
