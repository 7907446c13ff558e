#pragma once

#include <array>

namespace condyle::tangential {

/// Angle of (x, y) counter-clockwise from +x, in [-pi, pi]; 0 for (0, 0).
///
/// As std::atan2, but with one sequence of operations, each rounded by itself: the same bits in scalars and
/// in vectors of any instruction set. Let q be the tangent left in [-tan(pi/8), tan(pi/8)] and a its
/// arctangent,
///
///     low / high or (low - high) / (low + high),   of low <= high, the absolute values of x and y,
///     a = q + q (q^2 P(q^2)),                      P of degree 10: off by 2^-59 of a;
///
/// the angle is a, from pi/4 if need be, that from pi/2, and that from pi.
///
/// q is off by 3u of itself and a by 5u, which are 2u radians; the multiples of pi/4 by 2u together, and the
/// three sums are rounded by 1/2u, 1u and 2u: at most 5u of the angle within pi/8 of +x, 8u radians
/// elsewhere.
double arctangent(double y, double x) noexcept;

/// (arctan(sqrt(s)) / sqrt(s) - 1) / s on [0, tan(pi/8)^2], minimax, from the constant up.
inline constexpr std::array<double, 11> arctangent_coefficients = {
    -0x1.555555555553dp-2, 0x1.99999999958e1p-3, -0x1.24924922b0ed3p-3, 0x1.c71c70e7922c5p-4,
    -0x1.745cf9099d774p-4, 0x1.3b111c4e5ecbap-4, -0x1.10ebdcc8cd72ep-4, 0x1.df115d1d03522p-5,
    -0x1.9cdbfe91053a9p-5, 0x1.37ece7a5c207bp-5, -0x1.259ca0a18d670p-6};

/// tan(pi/8).
inline constexpr double eighth_tangent = 0x1.a827999fcef32p-2;

}  // namespace condyle::tangential
