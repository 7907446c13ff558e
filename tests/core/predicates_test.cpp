#include "core/predicates.hpp"

#include <boost/multiprecision/cpp_int.hpp>

#include "support/test.hpp"

namespace condyle {
namespace {

using Rational = boost::multiprecision::cpp_rational;

core::Sign exact_orientation(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const auto e = [](const Vec3& p, const Vec3& q, int k) { return Rational(p[k]) - Rational(q[k]); };
  const Rational det = e(d, a, 0) * (e(b, a, 1) * e(c, a, 2) - e(b, a, 2) * e(c, a, 1)) +
                       e(d, a, 1) * (e(b, a, 2) * e(c, a, 0) - e(b, a, 0) * e(c, a, 2)) +
                       e(d, a, 2) * (e(b, a, 0) * e(c, a, 1) - e(b, a, 1) * e(c, a, 0));
  return static_cast<core::Sign>(det.sign());
}

TEST(Predicates, OrientationOfFourNearlyCoplanarPointsIsThatOfRationalArithmetic) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-1, 1);
  int zero = 0, positive = 0, negative = 0;
  for (int i = 0; i < 3000; ++i) {
    const Vec3 a(uniform(random), uniform(random), uniform(random)), u(uniform(random), 0.5, uniform(random));
    const Vec3 v(0.25, uniform(random), uniform(random));
    const Vec3 d = a + 0.5 * u + 0.25 * v;
    const core::Sign sign = core::orientation(a, Vec3(a + u), Vec3(a + v), d);
    EXPECT_EQ(sign, exact_orientation(a, a + u, a + v, d));
    (sign == core::Sign::zero ? zero : sign == core::Sign::positive ? positive : negative)++;
  }
  // The points are coplanar but for rounding: all three answers must occur, or nothing was tested.
  EXPECT_GT(zero, 0);
  EXPECT_GT(positive, 0);
  EXPECT_GT(negative, 0);
}

TEST(Predicates, OrientationAboutTheOriginAgreesWithFourPointOrientation) {
  std::mt19937 random(2);
  std::uniform_int_distribution<int> grid(-2, 2);
  for (int i = 0; i < 3000; ++i) {
    const auto point = [&] { return Vec3(0.1 * grid(random), 0.1 * grid(random), 0.1 * grid(random)); };
    const Vec3 a = point(), b = point(), c = point();
    // det[a b c] is (a - 0) x (b - 0) . (c - 0).
    EXPECT_EQ(core::orientation(a, b, c), exact_orientation(Vec3::Zero(), a, b, c));
    EXPECT_EQ(core::orientation(a, b, c), -core::orientation(b, a, c));
    EXPECT_EQ(core::orientation(a, b, c), core::orientation(b, c, a));
  }
}

TEST(Predicates, ExchangingTwoArgumentsNegatesTheFilteredValueToTheLastBit) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 v(uniform(random), uniform(random), uniform(random));
    const Vec3 a(uniform(random), uniform(random), uniform(random)), b(uniform(random), uniform(random), 1);
    EXPECT_EQ(core::filtered_determinant(v, a, b).value, -core::filtered_determinant(v, b, a).value);
  }
}

TEST(Predicates, SubnormalAndHugeCoordinatesAreDecided) {
  const double tiny = std::numeric_limits<double>::denorm_min(), huge = std::numeric_limits<double>::max();
  EXPECT_EQ(core::orientation(Vec3(tiny, 0, 0), Vec3(0, tiny, 0), Vec3(0, 0, tiny)), core::Sign::positive);
  EXPECT_EQ(core::orientation(Vec3(huge, 0, 0), Vec3(0, huge, 0), Vec3(0, 0, -huge)), core::Sign::negative);
  EXPECT_EQ(core::orientation(Vec3(huge, 0, 0), Vec3(0, tiny, 0), Vec3(0, huge, 0)), core::Sign::zero);
  EXPECT_EQ(core::determinant_2x2(tiny, tiny, tiny, tiny), core::Sign::zero);
  EXPECT_EQ(core::determinant_2x2(huge, tiny, -tiny, huge), core::Sign::positive);
  EXPECT_EQ(core::orientation_2d(0, 0, huge, huge, -huge, -huge), core::Sign::zero);
  EXPECT_EQ(core::orientation_2d(-huge, 0, huge, tiny, huge, 2 * tiny), core::Sign::positive);
}

TEST(Predicates, ThreePointsOnALineThatDoubleArithmeticBends) {
  // 0.1 k is rounded: whether these are collinear is a matter of the last bit, and must be that of the
  // doubles.
  for (int k = 1; k < 200; ++k) {
    const double x = 0.1 * k, y = 0.3 * k;
    const Rational left = (Rational(0.7) - Rational(0.1)) * (Rational(y) - Rational(0.3));
    const Rational right = (Rational(2.1) - Rational(0.3)) * (Rational(x) - Rational(0.1));
    EXPECT_EQ(core::orientation_2d(0.1, 0.3, 0.7, 2.1, x, y),
              static_cast<core::Sign>(Rational(left - right).sign()));
  }
}

TEST(Predicates, IntegersInPlaceHoldWhateverDoublesAreFarApart) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> uniform(0.5, 1);
  std::bernoulli_distribution coin;
  // About 168 bits, where larger integers take over, and up to all that doubles span.
  for (const int apart : {0, 60, 113, 114, 115, 116, 117, 400, 1100, 1990}) {
    for (int i = 0; i < 40; ++i) {
      const auto number = [&] {
        const double value = std::ldexp(uniform(random), (coin(random) ? apart : 0) - 1000);
        return coin(random) ? value : -value;
      };
      const auto point = [&] { return Vec3(number(), number(), number()); };
      const Vec3 a = point(), b = point(), c = point(), d = point();
      EXPECT_EQ(core::exact::orientation(a, b, c, d), exact_orientation(a, b, c, d)) << apart;
      EXPECT_EQ(core::exact::orientation(a, b, c), exact_orientation(Vec3::Zero(), a, b, c)) << apart;
      const auto product = [](double x, double y) { return Rational(x) * Rational(y); };
      const Rational minor = product(a.x(), b.y()) - product(a.y(), b.x());
      EXPECT_EQ(core::exact::determinant_2x2(a.x(), a.y(), b.x(), b.y()),
                static_cast<core::Sign>(minor.sign()));
    }
  }
}

}  // namespace
}  // namespace condyle
