#include "condyle/tangential/arctangent.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace condyle {

double arctangent(double y, double x) noexcept {
  constexpr double pi = std::numbers::pi;
  const double ax = std::abs(x), ay = std::abs(y), low = std::min(ax, ay), high = std::max(ax, ay);
  if (high == 0) return 0;
  const bool beyond_eighth = low > high * eighth_tangent;
  const double q = (beyond_eighth ? low - high : low) / (beyond_eighth ? low + high : high);
  const double s = q * q;
  double p = arctangent_coefficients.back();
  for (std::size_t k = arctangent_coefficients.size() - 1; k-- > 0;) p = p * s + arctangent_coefficients[k];
  const double a = q + q * (s * p);
  const double to_quarter = (beyond_eighth ? pi / 4 : 0.0) + a;
  const double to_half = ay > ax ? pi / 2 - to_quarter : to_quarter;
  const double angle = x < 0 ? pi - to_half : to_half;
  return y < 0 ? -angle : angle;
}

}  // namespace condyle
