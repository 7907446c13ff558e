#include "tangential/exact/arctangent.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace condyle::tangential {

double arctangent(double y, double x) noexcept {
  constexpr double pi = std::numbers::pi;
  const double ax = std::abs(x), ay = std::abs(y), low = std::min(ax, ay), high = std::max(ax, ay);
  if (high == 0) return 0;
  const bool beyond_eighth = low > high * eighth_tangent;
  const double q = (beyond_eighth ? low - high : low) / (beyond_eighth ? low + high : high);
  const double s = q * q;
  // Pairs before sums: in vectors no step waits for the ten before it.
  const double s2 = s * s, s4 = s2 * s2;
  const auto& c = arctangent_coefficients;
  const auto two = [&](std::size_t k) { return c[k] + s * c[k + 1]; };
  const auto four = [&](std::size_t k) { return two(k) + s2 * two(k + 2); };
  const double p = four(0) + s4 * (four(4) + s4 * (two(8) + s2 * c[10]));
  const double a = q + q * (s * p);
  const double to_quarter = (beyond_eighth ? pi / 4 : 0.0) + a;
  const double to_half = ay > ax ? pi / 2 - to_quarter : to_quarter;
  const double angle = x < 0 ? pi - to_half : to_half;
  return y < 0 ? -angle : angle;
}

}  // namespace condyle::tangential
