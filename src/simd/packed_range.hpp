#pragma once

#include <cstdint>

namespace condyle::simd {

/// Two ranges of bytes packed in 32 bits, from the lowest byte: least a, 255 - greatest a, least b, 255 -
/// greatest b. A point is two ranges of one value each: ranges hold it where no byte of theirs exceeds its own.
using PackedRange = std::uint32_t;

constexpr PackedRange packed_range(int least_a, int greatest_a, int least_b, int greatest_b) noexcept {
  return static_cast<PackedRange>(least_a) | static_cast<PackedRange>(255 - greatest_a) << 8 |
         static_cast<PackedRange>(least_b) << 16 | static_cast<PackedRange>(255 - greatest_b) << 24;
}

/// Whether no byte of the range exceeds the point's.
constexpr bool holds(PackedRange range, PackedRange point) noexcept {
  for (int shift = 0; shift < 32; shift += 8) {
    if ((range >> shift & 255) > (point >> shift & 255)) return false;
  }
  return true;
}

}  // namespace condyle::simd
