#pragma once

/// Sine, cosine, arctangent and hypotenuse with the same bits everywhere. Those of C libraries are right to half a unit in the last place
/// and a little more, and which of two neighbours they give depends on the library, its version and the instruction set. These
/// are made of sums, products, quotients and square roots of doubles, most in pairs, alone. Their errors before the last rounding are at most 2^-67
/// of them: all but one in 2^13, at worst, are the exact value, rounded once.

#include <cmath>

namespace condyle::core {

struct SineCosine {
  double sine, cosine;
};

/// Sine and cosine of an angle of at most 2^20 radians in either sense; larger ones are the C library's.
SineCosine sine_cosine(double radians) noexcept;

inline double sine(double radians) noexcept {
  return sine_cosine(radians).sine;
}
inline double cosine(double radians) noexcept {
  return sine_cosine(radians).cosine;
}
inline double tangent(double radians) noexcept {
  const auto [sine, cosine] = sine_cosine(radians);
  return sine / cosine;
}

/// The angle of (x, y) in [-pi, pi], as std::atan2 has it, signs of zeros included.
double arctangent(double y, double x) noexcept;

/// In [0, pi], and in [-pi/2, pi/2]; NaN beyond 1. Next to the ends 1 - |cosine| is what decides, and has its own bits.
inline double arccosine(double cosine) noexcept {
  return arctangent(std::sqrt((1 - cosine) * (1 + cosine)), cosine);
}
inline double arcsine(double sine) noexcept {
  return arctangent(sine, std::sqrt((1 - sine) * (1 + sine)));
}

/// The length of (x, y), whose squares are in the range of doubles. That of the C library would ask for glibc 2.35.
double hypotenuse(double x, double y) noexcept;

}  // namespace condyle::core
