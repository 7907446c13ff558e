#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace condyle::simd {

/// For each mask of eight lanes those that are set, in their order, and 0 for what is left.
inline constexpr std::array<std::array<std::uint8_t, 8>, 256> compaction_lanes = [] {
  std::array<std::array<std::uint8_t, 8>, 256> table{};
  for (unsigned mask = 0; mask < table.size(); ++mask) {
    std::size_t count = 0;
    for (unsigned lane = 0; lane < 8; ++lane) {
      if ((mask >> lane & 1) != 0) table[mask][count++] = static_cast<std::uint8_t>(lane);
    }
  }
  return table;
}();

}  // namespace condyle::simd
