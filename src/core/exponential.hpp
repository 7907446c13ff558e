#pragma once

/// Exponentials and logarithms with the same bits everywhere, as core/trigonometry.hpp has sines, and as near to the exact value: their
/// errors before the last rounding are at most 2^-67 of them.

namespace condyle::core {

/// e^x; beyond 700 in either sense the C library's.
double exponential(double x) noexcept;

/// e^x - 1, with all its digits next to 0.
double exponential_less_1(double x) noexcept;

/// The natural logarithm; that of no number, 0 and below, is the C library's.
double logarithm(double x) noexcept;

/// The logarithm of 1 + x, with all its digits next to 0.
double logarithm_of_1_and(double x) noexcept;

/// The z below which this share of the standard normal distribution lies, above 0 and below 1: right to some units in the last
/// place. M. J. Wichura, Algorithm AS 241: The percentage points of the normal distribution, Applied Statistics 37, 1988, PPND16.
double normal_quantile(double share) noexcept;

}  // namespace condyle::core
