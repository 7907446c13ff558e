#pragma once

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstdint>
#include <limits>

namespace condyle::simd {

/// An interval of radii, least and greatest, packed in 32 bits: code of the least squared radius below, and
/// 65535 minus the code of the greatest above. The hull of two intervals is then the smaller of each half.
using PackedInterval = std::uint32_t;

/// The interval that holds nothing: no point is between its ends, and a hull with it changes nothing.
inline constexpr PackedInterval no_radii = 0xffffffffu;

inline constexpr int greatest_radius_code = 0xffff;

constexpr PackedInterval packed_interval(int least_code, int greatest_code) noexcept {
  return static_cast<PackedInterval>(least_code) |
         static_cast<PackedInterval>(greatest_radius_code - greatest_code) << 16;
}

constexpr PackedInterval hull(PackedInterval a, PackedInterval b) noexcept {
  return std::min(a & 0xffffu, b & 0xffffu) | std::min(a & 0xffff0000u, b & 0xffff0000u);
}

/// Squared radii as codes of 16 bits. The bits of positive floats, read as integers, are in the floats' own
/// order: a code is a slice of them, so that it rises with the radius and its steps are relative ones (about
/// 3e-5 of a radius for a hip bone).
///
///   bits of r^2   |sign|exponent|        fraction        |
///                      |<----- 16 bits of the difference to the base ---->|
///
/// The first and the last code are kept for what lies outside the scale: an interval that ends in one of them
/// has no end there, and no interval within the scale reaches points outside of it.
struct IntervalScale {
  std::int32_t base = 0;
  std::int32_t shift = 0;

  IntervalScale() = default;
  IntervalScale(float least_squared, float greatest_squared) noexcept {
    assert(least_squared >= 0 && least_squared <= greatest_squared);
    while ((bits(greatest_squared) - bits(least_squared)) >> shift > greatest_radius_code - 2) ++shift;
    base = bits(least_squared) - (1 << shift);
  }

  int code(float squared) const noexcept {
    return std::clamp((bits(squared) - base) >> shift, 0, greatest_radius_code);
  }

  /// No squared radius of that code is smaller, or is greater.
  float least(int code) const noexcept { return code == 0 ? 0.0f : value(code); }
  float greatest(int code) const noexcept {
    return code == greatest_radius_code ? std::numeric_limits<float>::infinity() : value(code + 1);
  }

 private:
  static std::int32_t bits(float squared) noexcept { return std::bit_cast<std::int32_t>(squared); }
  float value(int code) const noexcept { return std::bit_cast<float>(base + (code << shift)); }
};

}  // namespace condyle::simd
