#pragma once

/// Sine, cosine, arctangent and hypotenuse with the same bits everywhere. Those of C libraries are right to half a unit in the last place
/// and a little more, and which of two neighbours they give depends on the library, its version and the instruction set. These
/// are made of sums, products, quotients and square roots of doubles, most in pairs, alone. Their errors before the last rounding are at most 2^-67
/// of them: all but one in 2^13, at worst, are the exact value, rounded once.

namespace condyle::core {

struct SineCosine {
  double sine, cosine;
};

/// Sine and cosine of an angle of at most 2^20 radians in either sense; larger ones are the C library's.
SineCosine sine_cosine(double radians) noexcept;

/// The angle of (x, y) in [-pi, pi], as std::atan2 has it, signs of zeros included.
double arctangent(double y, double x) noexcept;

/// The length of (x, y), whose squares are in the range of doubles. That of the C library would ask for glibc 2.35.
double hypotenuse(double x, double y) noexcept;

}  // namespace condyle::core
