#include "core/exponential.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "core/pair.hpp"

namespace condyle::core {
namespace {

/// The logarithm of 2 in three doubles; products of the first two with the number of halvings are exact.
constexpr double ln_2[3] = {0x1.62e42fefap-1, 0x1.cf79abc9ep-40, 0x1.cc01f97b57a08p-87};

/// e^(k / 64), each from the one nearer to 1, as far as half the logarithm of 2.
constexpr int parts_of_one = 64, most_parts = 23;
constexpr auto powers = [] {
  std::array<Pair, 2 * most_parts + 1> powers{};
  powers[most_parts] = {1, 0};
  for (const int sense : {-1, 1}) {
    // Taylor's series of e^(1 / 64), from its last term.
    Pair step{1, 0};
    for (int n = 16; n >= 1; --n) {
      const double high = sense / (64.0 * n);
      const Pair missing = Pair{sense / 64.0, 0} - exact_product(high, n);
      step = Pair{1, 0} + step * Pair{high, missing.high / n};
    }
    for (int k = 1; k <= most_parts; ++k) {
      const auto at = static_cast<std::size_t>(most_parts + sense * k);
      powers[at] = powers[at - static_cast<std::size_t>(sense)] * step;
    }
  }
  return powers;
}();

/// e^x is 2^halvings (1 + more).
struct Power {
  int halvings;
  Pair more;
};

/// e^(k / 64) and Taylor's series of what is left, t. From t^3 / 6 on terms are at most 2^-16 of it, so that doubles do.
Power power_of(double x) noexcept {
  const double halvings = std::floor(x / std::numbers::ln2 + 0.5);
  const Pair whole = exact_sum(x - halvings * ln_2[0], -halvings * ln_2[1]);
  const double k = std::floor(parts_of_one * whole.high + 0.5);
  const double low = whole.low - halvings * ln_2[2];
  const Pair t = exact_sum(whole.high - k / parts_of_one, low);
  const Pair square = exact_product(t.high, t.high);
  const double cubes =
      t.high * square.high *
      (1.0 / 6 + t.high * (1.0 / 24 + t.high * (1.0 / 120 + t.high * (1.0 / 720 + t.high * (1.0 / 5040)))));
  const Pair beyond = t + Pair{square.high / 2, square.low / 2 + (t.high * t.low + cubes)};
  if (k == 0) return {static_cast<int>(halvings), beyond};
  const Pair power = powers[static_cast<std::size_t>(most_parts + static_cast<int>(k))];
  return {static_cast<int>(halvings), (power - Pair{1, 0}) + power * beyond};
}

/// The logarithm of a number above 0, a = 2^power m. With y near that of m, the latter is y + (m e^-y - 1), to a part in 2^80.
double logarithm_of(Pair a) noexcept {
  int power = std::ilogb(a.high);
  if (std::ldexp(a.high, -power) > std::numbers::sqrt2) ++power;
  const Pair m{std::ldexp(a.high, -power), std::ldexp(a.low, -power)}, beyond_1 = m - Pair{1, 0};
  const double s = beyond_1.high / (2 + beyond_1.high), q = s * s;
  const double y =
      2 * s *
      (1 + q * (1.0 / 3 + q * (1.0 / 5 + q * (1.0 / 7 + q * (1.0 / 9 + q * (1.0 / 11 + q * (1.0 / 13)))))));
  const Pair rest = beyond_1 + m * power_of(-y).more;
  Pair sum = Pair{y, 0} + rest;
  if (power != 0)
    for (const double part : ln_2) sum = Pair{power * part, 0} + sum;
  return sum.high;
}

double quotient_of(const double (&above)[8], const double (&below)[8], double r) noexcept {
  double numerator = above[7], denominator = below[7];
  for (int k = 6; k >= 0; --k) numerator = numerator * r + above[k], denominator = denominator * r + below[k];
  return numerator / denominator;
}

}  // namespace

double exponential(double x) noexcept {
  if (!(std::abs(x) <= 700)) return std::exp(x);
  const auto [halvings, more] = power_of(x);
  return std::ldexp((Pair{1, 0} + more).high, halvings);
}

double exponential_less_1(double x) noexcept {
  if (!(std::abs(x) <= 700)) return std::expm1(x);
  // Nearer to x than to any other number.
  if (std::abs(x) < 0x1p-54) return x;
  const auto [halvings, more] = power_of(x);
  if (halvings == 0) return more.high;
  const Pair power = Pair{1, 0} + more;
  return (Pair{std::ldexp(power.high, halvings), std::ldexp(power.low, halvings)} - Pair{1, 0}).high;
}

double logarithm(double x) noexcept {
  if (!(x > 0 && std::isfinite(x))) return std::log(x);
  return logarithm_of({x, 0});
}

double logarithm_of_1_and(double x) noexcept {
  if (!(x > -1 && std::isfinite(x))) return std::log1p(x);
  if (std::abs(x) < 0x1p-54) return x;
  return logarithm_of(exact_sum(1, x));
}

double normal_quantile(double share) noexcept {
  constexpr double middle_above[8] = {
      3.3871328727963666080,    1.3314166789178437745e+2, 1.9715909503065514427e+3, 1.3731693765509461125e+4,
      4.5921953931549871457e+4, 6.7265770927008700853e+4, 3.3430575583588128105e+4, 2.5090809287301226727e+3};
  constexpr double middle_below[8] = {1,
                                      4.2313330701600911252e+1,
                                      6.8718700749205790830e+2,
                                      5.3941960214247511077e+3,
                                      2.1213794301586595867e+4,
                                      3.9307895800092710610e+4,
                                      2.8729085735721942674e+4,
                                      5.2264952788528545610e+3};
  constexpr double side_above[8] = {1.42343711074968357734,    4.63033784615654529590,
                                    5.76949722146069140550,    3.64784832476320460504,
                                    1.27045825245236838258,    2.41780725177450611770e-1,
                                    2.27238449892691845833e-2, 7.74545014278341407640e-4};
  constexpr double side_below[8] = {1,
                                    2.05319162663775882187,
                                    1.67638483018380384940,
                                    6.89767334985100004550e-1,
                                    1.48103976427480074590e-1,
                                    1.51986665636164571966e-2,
                                    5.47593808499534494600e-4,
                                    1.05075007164441684324e-9};
  constexpr double end_above[8] = {6.65790464350110377720,    5.46378491116411436990,
                                   1.78482653991729133580,    2.96560571828504891230e-1,
                                   2.65321895265761230930e-2, 1.24266094738807843860e-3,
                                   2.71155556874348757815e-5, 2.01033439929228813265e-7};
  constexpr double end_below[8] = {1,
                                   5.99832206555887937690e-1,
                                   1.36929880922735805310e-1,
                                   1.48753612908506148525e-2,
                                   7.86869131145613259100e-4,
                                   1.84631831751005468180e-5,
                                   1.42151175831644588870e-7,
                                   2.04426310338993978564e-15};
  const double q = share - 0.5;
  if (std::abs(q) <= 0.425) return q * quotient_of(middle_above, middle_below, 0.180625 - q * q);
  const double r = std::sqrt(-logarithm(q < 0 ? share : 1 - share));
  return std::copysign(
      r <= 5 ? quotient_of(side_above, side_below, r - 1.6) : quotient_of(end_above, end_below, r - 5), q);
}

}  // namespace condyle::core
