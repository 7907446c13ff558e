#include "core/exponential.hpp"

#include <boost/math/special_functions/erf.hpp>

#include "core/misrounded.hpp"
#include "support/test.hpp"

namespace condyle::core {
namespace {

/// Near 0, where little but the first digits of e^x is left of e^x - 1, and far from it; next to odd halves of the logarithm of 2, where the
/// powers of two meet.
std::vector<double> exponents() {
  std::mt19937_64 random(8);
  std::vector<double> exponents;
  for (const double most : {1e-12, 1e-6, 0.1, 1.0, 20.0, 690.0}) {
    std::uniform_real_distribution<double> exponent(-most, most);
    for (int i = 0; i < 1000; ++i) exponents.push_back(exponent(random));
  }
  for (int halves = -41; halves <= 41; halves += 2) {
    const double x = halves * std::numbers::ln2 / 2;
    for (const double near : {x, std::nextafter(x, infinity), std::nextafter(x, -infinity)})
      exponents.push_back(near);
  }
  return exponents;
}

TEST(Exponential, PowersAreTheExactOnesRoundedOnce) {
  Misrounded misrounded;
  for (const double x : exponents()) {
    misrounded.hold(exponential(x), exp(Long(x)));
    misrounded.hold(exponential_less_1(x), expm1(Long(x)));
  }
}

TEST(Exponential, LogarithmsAreTheExactOnesRoundedOnce) {
  Misrounded misrounded;
  for (const double x : exponents()) {
    const double power = std::exp(x), more = std::expm1(x);
    if (power != 1) misrounded.hold(logarithm(power), log(Long(power)));
    if (more > -1) misrounded.hold(logarithm_of_1_and(more), log1p(Long(more)));
  }
  for (const double x : {5e-324, 1e-310, std::numeric_limits<double>::max(), std::nextafter(1.0, 2.0),
                         std::nextafter(1.0, 0.0)})
    misrounded.hold(logarithm(x), log(Long(x)));
}

TEST(Exponential, EndsAndWhatIsNoNumberAreAsInTheStandardLibrary) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(exponential(0), 1);
  EXPECT_EQ(exponential(1000), infinity);
  EXPECT_EQ(exponential(-1000), 0);
  EXPECT_EQ(exponential_less_1(-1000), -1);
  EXPECT_TRUE(std::signbit(exponential_less_1(-0.0)) && std::signbit(logarithm_of_1_and(-0.0)));
  EXPECT_EQ(logarithm(1), 0);
  EXPECT_EQ(logarithm(0), -infinity);
  EXPECT_EQ(logarithm(infinity), infinity);
  EXPECT_EQ(logarithm_of_1_and(-1), -infinity);
  EXPECT_TRUE(std::isnan(exponential(nan)) && std::isnan(logarithm(nan)) && std::isnan(logarithm(-1)));
  EXPECT_TRUE(std::isnan(exponential_less_1(nan)) && std::isnan(logarithm_of_1_and(-2)));
}

/// Right to some units in the last place: a quotient of two polynomials of eight terms.
TEST(Exponential, QuantilesOfTheNormalDistributionAreThoseOfBoost) {
  std::mt19937_64 random(9);
  std::uniform_real_distribution<double> share(0, 1), power(-300, 0);
  for (int i = 0; i < 20000; ++i) {
    const double below = i % 2 == 0 ? share(random) : std::pow(10, power(random));
    const double expected = -std::numbers::sqrt2 * boost::math::erfc_inv(2 * below);
    EXPECT_NEAR(normal_quantile(below), expected, 0x1p-49 * std::abs(expected)) << below;
  }
  EXPECT_EQ(normal_quantile(0.5), 0);
  EXPECT_EQ(normal_quantile(0.25), -normal_quantile(0.75));
}

}  // namespace
}  // namespace condyle::core
