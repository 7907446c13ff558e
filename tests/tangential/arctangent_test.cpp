#include "tangential/exact/arctangent.hpp"

#include "core/predicates.hpp"
#include "support/test.hpp"

namespace condyle::tangential {
namespace {

/// Against long double, which has 11 bits more: 5u of the angle within an eighth of pi of +x, else 8u.
void expect_within_bound(double y, double x) {
  const long double exact = std::atan2(static_cast<long double>(y), static_cast<long double>(x));
  const double error =
      static_cast<double>(std::abs(static_cast<long double>(tangential::arctangent(y, x)) - exact));
  const bool beside_x = x > 0 && std::abs(y) <= tangential::eighth_tangent * x;
  const double unit = beside_x ? 5 * std::abs(static_cast<double>(exact)) : 8;
  EXPECT_LE(error, unit * core::rounding_unit + std::numeric_limits<double>::denorm_min()) << y << " " << x;
}

TEST(Arctangent, IsKnownAlongTheAxesAndDiagonals) {
  constexpr double pi = std::numbers::pi;
  EXPECT_EQ(tangential::arctangent(0, 3), 0);
  EXPECT_EQ(tangential::arctangent(0, 0), 0);
  EXPECT_EQ(tangential::arctangent(2, 0), pi / 2);
  EXPECT_EQ(tangential::arctangent(-2, 0), -pi / 2);
  EXPECT_EQ(tangential::arctangent(0, -1), pi);
  EXPECT_EQ(tangential::arctangent(7, 7), pi / 4);
  EXPECT_EQ(tangential::arctangent(-7, 7), -pi / 4);
  EXPECT_EQ(tangential::arctangent(7, -7), 3 * pi / 4);
}

TEST(Arctangent, ErrsByNoMoreThanItsBound) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int i = 0; i < 300000; ++i) {
    const double x = uniform(random), y = uniform(random);
    expect_within_bound(y, x);
    expect_within_bound(y * std::exp2(60 * uniform(random)), x);
  }
}

TEST(Arctangent, KeepsItsBoundBesideTheBordersOfItsParts) {
  for (const double tangent : {tangential::eighth_tangent, 1.0, 1 / tangential::eighth_tangent}) {
    double below = tangent, above = tangent;
    for (int i = 0; i < 50; ++i) {
      for (const double y : {below, above, -below, -above})
        expect_within_bound(y, 1), expect_within_bound(y, -1);
      below = std::nextafter(below, 0), above = std::nextafter(above, 9);
    }
  }
}

}  // namespace
}  // namespace condyle::tangential
