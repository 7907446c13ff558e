#pragma once

#include <algorithm>
#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <limits>

#include "core/predicates.hpp"

/// The exact stage of the predicates: doubles as integers with one common power of two. For .cpp files only,
/// so that Boost stays out of what users of the library compile.

namespace condyle::core::exact {

using Integer = boost::multiprecision::cpp_int;

/// The doubles as integers: out[i] = in[i] * 2^k, one k for all, every digit kept. The sign of a homogeneous
/// polynomial of them is the sign of the same polynomial of the doubles. All must be finite.
template <std::size_t N, class Int = Integer>
std::array<Int, N> to_integers(const std::array<double, N>& in) {
  std::array<long long, N> mantissa{};
  std::array<int, N> exponent{};
  int lowest = std::numeric_limits<int>::max();
  for (std::size_t i = 0; i < N; ++i) {
    if (in[i] == 0) continue;
    int e = 0;
    mantissa[i] = static_cast<long long>(std::ldexp(std::frexp(in[i], &e), 53));
    exponent[i] = e - 53;
    lowest = std::min(lowest, exponent[i]);
  }
  std::array<Int, N> out;
  for (std::size_t i = 0; i < N; ++i) {
    if (mantissa[i] == 0) continue;
    out[i] = mantissa[i];
    out[i] <<= static_cast<unsigned>(exponent[i] - lowest);
  }
  return out;
}

template <class Backend, boost::multiprecision::expression_template_option templates>
Sign sign_of(const boost::multiprecision::number<Backend, templates>& value) noexcept {
  return static_cast<Sign>(value.sign());
}

/// numerator / denominator as a double, correct to one unit in the last place; the denominator is not zero.
inline double quotient(Integer numerator, Integer denominator) {
  if (numerator == 0) return 0;
  const bool negative = (numerator.sign() < 0) != (denominator.sign() < 0);
  numerator = abs(numerator);
  denominator = abs(denominator);
  // Shift so that the integer quotient keeps at least 64 bits, more than a double holds.
  const int shift = 65 + static_cast<int>(msb(denominator)) - static_cast<int>(msb(numerator));
  if (shift > 0) {
    numerator <<= static_cast<unsigned>(shift);
  } else {
    denominator <<= static_cast<unsigned>(-shift);
  }
  const double value = std::ldexp(static_cast<double>(Integer(numerator / denominator)), -shift);
  return negative ? -value : value;
}

}  // namespace condyle::core::exact
