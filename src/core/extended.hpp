#pragma once

#include <cfloat>
#include <cstdint>
#include <cstring>

namespace condyle::core {

#if LDBL_MANT_DIG == 113

/// The long double of x86, 64 bits of mantissa, where long double has 113 as in WebAssembly: each result is rounded once more, to even. That is
/// the one rounding of x86 but where the first one ends in the middle between two of 64 bits, once in 2^48.
class Extended {
 public:
  Extended(double value) noexcept : value_(value) {}
  explicit operator double() const noexcept { return static_cast<double>(value_); }

  friend Extended operator*(Extended a, Extended b) noexcept { return rounded(a.value_ * b.value_); }
  friend Extended operator+(Extended a, Extended b) noexcept { return rounded(a.value_ + b.value_); }
  friend bool operator==(Extended a, Extended b) noexcept { return a.value_ == b.value_; }

 private:
  /// Drops the 49 last bits of the mantissa. Carries go on into the exponent, as they should; infinities and NaN have no such bits but those
  /// that make them NaN.
  static Extended rounded(long double value) noexcept {
    constexpr int dropped = LDBL_MANT_DIG - 64;
    constexpr std::uint64_t half = std::uint64_t{1} << (dropped - 1), rest = (half << 1) - 1;
    std::uint64_t words[2];
    static_assert(sizeof words == sizeof value);
    std::memcpy(words, &value, sizeof value);
    const std::uint64_t tail = words[0] & rest, is_odd = words[0] >> dropped & 1;
    words[0] -= tail;
    if (tail > half || (tail == half && is_odd != 0)) {
      words[0] += half << 1;
      if (words[0] == 0) ++words[1];
    }
    Extended out(0);
    std::memcpy(&out.value_, words, sizeof value);
    return out;
  }

  long double value_;
};

#else

using Extended = long double;

#endif

}  // namespace condyle::core
