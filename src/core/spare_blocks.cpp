#include "core/spare_blocks.hpp"

#include <algorithm>

namespace condyle::core {

SpareBlocks::Block SpareBlocks::remove(std::size_t place) noexcept {
  const Block block = block_[place];
  std::copy(block_.begin() + place + 1, block_.begin() + count_, block_.begin() + place);
  --count_, bytes_ -= block.bytes;
  return block;
}

void* SpareBlocks::take(std::size_t bytes) noexcept {
  const std::scoped_lock lock(mutex_);
  for (std::size_t place = count_; place-- > 0;)
    if (block_[place].bytes == bytes) return remove(place).memory;
  return nullptr;
}

void SpareBlocks::keep(void* memory, std::size_t bytes) noexcept {
  if (bytes > most_bytes_) {
    release_(memory, bytes);
    return;
  }
  const std::scoped_lock lock(mutex_);
  while (count_ == most_blocks || bytes_ + bytes > most_bytes_) {
    const Block oldest = remove(0);
    release_(oldest.memory, oldest.bytes);
  }
  block_[count_++] = {memory, bytes}, bytes_ += bytes;
}

}  // namespace condyle::core
