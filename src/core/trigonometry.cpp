#include "core/trigonometry.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "core/pair.hpp"

namespace condyle::core {
namespace {

/// Times a power of two.
constexpr Pair scaled(Pair a, double power) noexcept {
  return {power * a.high, power * a.low};
}

constexpr Pair pi{0x1.921fb54442d18p+1, 0x1.1a62633145c07p-53},
    half_pi{0x1.921fb54442d18p+0, 0x1.1a62633145c07p-54};

struct SineCosinePair {
  Pair sine, cosine;
};

/// Sine and cosine of at most an eighth of a turn, and a little. Taylor's series of a sixteenth of the angle u, and
/// four doublings. The first terms are kept in pairs; from u^5 / 120 on they are a part in 10^7 of the sine, and
/// doubles do.
SineCosinePair of_small(Pair angle) noexcept {
  constexpr Pair sixth{0x1.5555555555555p-3, 0x1.5555555555555p-57},
      twenty_fourth{0x1.5555555555555p-5, 0x1.5555555555555p-59};
  const Pair u = scaled(angle, 1.0 / 16), v = u * u;
  const double x = v.high;
  const double of_sine = x * x * (1.0 / 120 - x * (1.0 / 5040 - x * (1.0 / 362880 - x * (1.0 / 39916800))));
  const double of_cosine = x * x * x * (1.0 / 720 - x * (1.0 / 40320 - x * (1.0 / 3628800)));
  Pair sine = u + u * (Pair{of_sine, 0} - v * sixth);
  Pair less = scaled(v, 0.5) - v * v * twenty_fourth + Pair{of_cosine, 0};  // 1 less the cosine
  for (int doubling = 0; doubling < 4; ++doubling) {
    const Pair half = sine;
    sine = scaled(half - half * less, 2);
    less = scaled(half * half, 2);
  }
  return {sine, Pair{1, 0} - less};
}

constexpr Pair quotient(Pair a, Pair b) noexcept {
  const double high = a.high / b.high;
  const Pair rest = a - b * Pair{high, 0};
  return ordered_sum(high, rest.high / b.high);
}

/// Arctangent of at most 1/128 and a little, by Taylor's series: the terms from r^3 / 3 on are at most 2^-15 of it,
/// so that doubles do: some roundings of 2^-53 make 2^-67.
constexpr Pair arctangent_of_small(Pair r) noexcept {
  const double x = r.high * r.high;
  const double more = r.high * x * (-1.0 / 3 + x * (1.0 / 5 - x * (1.0 / 7 - x * (1.0 / 9))));
  return r + Pair{more, 0};
}

/// Arctangents of k / 64, each from the one before it: the angle between them has the tangent 64 / (4096 + k (k - 1)).
constexpr int parts_of_tangent = 64;
constexpr auto arctangents = [] {
  std::array<Pair, parts_of_tangent + 1> angles{};
  for (int k = 1; k <= parts_of_tangent; ++k) {
    Pair r = quotient({64, 0}, {4096.0 + k * (k - 1), 0}), power = r, sum = r;
    const Pair square = r * r;
    for (int n = 3; n <= 21; n += 2) {
      power = -(power * square);
      sum = sum + quotient(power, {static_cast<double>(n), 0});
    }
    angles[static_cast<std::size_t>(k)] = angles[static_cast<std::size_t>(k - 1)] + sum;
  }
  return angles;
}();

}  // namespace

SineCosine sine_cosine(double radians) noexcept {
  if (!(std::abs(radians) <= 0x1p20)) return {std::sin(radians), std::cos(radians)};
  // Nearer to the angle, and to 1, than to any other number.
  if (std::abs(radians) < 0x1p-27) return {radians, 1};
  // A quarter turn in four doubles; products of the first two with the number of quarters are exact.
  constexpr double quarter[4] = {0x1.921fb544p+0, 0x1.0b4611a6p-34, 0x1.3198a2e037073p-69,
                                 0x1.129024e088a68p-123};
  const double quarters = std::floor(radians / half_pi.high + 0.5);
  Pair rest{radians, 0};
  for (const double part : quarter) rest = rest - exact_product(quarters, part);
  const auto [sine, cosine] = of_small(rest);
  switch (static_cast<int>(quarters) & 3) {
    case 0:
      return {sine.high, cosine.high};
    case 1:
      return {cosine.high, -sine.high};
    case 2:
      return {-sine.high, -cosine.high};
    default:
      return {-cosine.high, sine.high};
  }
}

double arctangent(double y, double x) noexcept {
  double small = std::abs(y), large = std::abs(x);
  const bool is_steep = small > large;
  if (is_steep) std::swap(small, large);
  if (!(small > 0 && std::isfinite(large))) return std::atan2(y, x);
  if (small < 0x1p-60 * large) {
    if (is_steep) return std::copysign(half_pi.high, y);
    return x < 0 ? std::copysign(pi.high, y) : y / x;
  }
  if (!(large > 0x1p-900 && large < 0x1p900)) {
    const int power = -std::ilogb(large);
    small = std::ldexp(small, power), large = std::ldexp(large, power);
  }
  // The angle beyond the nearest one whose tangent is k / 64.
  const auto k = static_cast<int>(parts_of_tangent * (small / large) + 0.5);
  const Pair beyond = quotient(Pair{parts_of_tangent * small, 0} - exact_product(large, k),
                               Pair{parts_of_tangent * large, 0} + exact_product(small, k));
  Pair angle = arctangents[static_cast<std::size_t>(k)] + arctangent_of_small(beyond);
  if (is_steep) angle = half_pi - angle;
  if (x < 0) angle = pi - angle;
  return std::copysign(angle.high, y);
}

double hypotenuse(double x, double y) noexcept {
  const double length = std::sqrt(x * x + y * y);
  if (!(length > 0) || !std::isfinite(length)) return length;
  const Pair missing = exact_product(x, x) + exact_product(y, y) - exact_product(length, length);
  return length + missing.high / (2 * length);
}

}  // namespace condyle::core
