#pragma once

#include <cfloat>
#include <cstdint>
#include <cstring>
#include <type_traits>

namespace condyle::core {

/// A number of 64 bits of mantissa, as the long double of x86, in one of 113: each result is rounded once more, to even. That is the one rounding of
/// x86 unless the first one ends in the middle between two of 64 bits, once in 2^48.
template <class Wide>
class RoundedTo64 {
 public:
  explicit RoundedTo64(double value) noexcept : value_(value) {}
  explicit operator double() const noexcept { return static_cast<double>(value_); }

  friend RoundedTo64 operator*(RoundedTo64 a, RoundedTo64 b) noexcept { return rounded(a.value_ * b.value_); }
  friend RoundedTo64 operator+(RoundedTo64 a, RoundedTo64 b) noexcept { return rounded(a.value_ + b.value_); }
  friend bool operator==(RoundedTo64 a, RoundedTo64 b) noexcept { return a.value_ == b.value_; }

 private:
  /// Drops the 49 last bits of the mantissa. A carry goes on into the exponent, as it should.
  static RoundedTo64 rounded(Wide value) noexcept {
    constexpr int dropped = 113 - 64;
    constexpr std::uint64_t half = std::uint64_t{1} << (dropped - 1), rest = (half << 1) - 1;
    std::uint64_t words[2];
    static_assert(sizeof words == sizeof value);
    std::memcpy(words, &value, sizeof value);
    const std::uint64_t tail = words[0] & rest;
    const bool is_odd = (words[0] >> dropped & 1) != 0;
    words[0] -= tail;
    if (tail > half || (tail == half && is_odd)) {
      words[0] += half << 1;
      if (words[0] == 0) ++words[1];
    }
    RoundedTo64 out(0);
    std::memcpy(&out.value_, words, sizeof value);
    return out;
  }

  Wide value_;
};

/// The same bits on machines whose long double has 64 bits of mantissa, and on those, like WebAssembly, where it has 113.
using Extended = std::conditional_t<LDBL_MANT_DIG == 113, RoundedTo64<long double>, long double>;

}  // namespace condyle::core
