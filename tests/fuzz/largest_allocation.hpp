#pragma once

#include <atomic>
#include <cstddef>

namespace condyle::test {

/// Bytes of the largest block of memory that this program has requested from operator new since this was last set to 0.
extern std::atomic<std::size_t> largest_allocation;

/// Bytes of memory that may be requested at once for an input of so many bytes: a number of two characters becomes eight
/// bytes, a vector grows by doubling, and deflate shortens up to 1032 times, for a number of a byte that becomes eight. Beside
/// it what libraries take for themselves.
constexpr std::size_t allowed_at_once(std::size_t input_bytes) {
  constexpr std::size_t growth = 8 * 1032, slack = std::size_t{1} << 20;
  return input_bytes * growth + slack;
}

}  // namespace condyle::test
