#include "core/trigonometry.hpp"

#include "core/misrounded.hpp"
#include "core/rotation_about.hpp"
#include "support/test.hpp"

namespace condyle::core {
namespace {

bool same(double a, double b) {
  return a == b && std::signbit(a) == std::signbit(b);
}

TEST(Trigonometry, SinesAndCosinesAreTheExactOnesRoundedOnce) {
  std::mt19937_64 random(3);
  std::vector<double> angles;
  for (const double most : {1e-6, 0.8, 3.2, 100.0, 1e6}) {
    std::uniform_real_distribution<double> angle(-most, most);
    for (int i = 0; i < 1500; ++i) angles.push_back(angle(random));
  }
  // Next to multiples of an eighth of a turn, where one of the two all but vanishes or the pieces of the series meet.
  for (int eighths = -40; eighths <= 40; ++eighths) {
    const double angle = eighths * std::numbers::pi / 4;
    for (const double near : {angle, std::nextafter(angle, infinity), std::nextafter(angle, -infinity)})
      if (near != 0) angles.push_back(near);
  }
  Misrounded misrounded;
  for (const double angle : angles) {
    const auto [sine, cosine] = sine_cosine(angle);
    misrounded.hold(sine, sin(Long(angle)));
    misrounded.hold(cosine, cos(Long(angle)));
  }
}

TEST(Trigonometry, ArctangentsAreTheExactOnesRoundedOnce) {
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> coordinate(-1, 1), power(-30, 30);
  Misrounded misrounded;
  for (int i = 0; i < 6000; ++i) {
    const double size = std::exp2(power(random)), y = size * coordinate(random), x = coordinate(random);
    misrounded.hold(arctangent(y, x), atan2(Long(y), Long(x)));
  }
  for (const double t :
       {1.0, std::nextafter(1.0, 2.0), std::nextafter(1.0, 0.0), 0x1p-59, 0x1p-61, 0x1p59, 0x1p61, 1e-50}) {
    for (const double x : {1.0, -1.0, 3e250, -1e-250, 1e-310}) {
      for (const double y : {t * x, -t * x}) misrounded.hold(arctangent(y, x), atan2(Long(y), Long(x)));
    }
  }
}

TEST(Trigonometry, HypotenusesAreTheExactOnesRoundedOnce) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> coordinate(-1, 1), power(-60, 60);
  Misrounded misrounded;
  for (int i = 0; i < 20000; ++i) {
    const double x = coordinate(random), y = std::exp2(power(random)) * coordinate(random);
    misrounded.hold(hypotenuse(x, y), static_cast<Long>(sqrt(Long(x) * Long(x) + Long(y) * Long(y))));
  }
  EXPECT_EQ(hypotenuse(-3, 4), 5);
  for (const double x : {0.0, -0.0, 1.0, -2.5, infinity})
    for (const double y : {0.0, -0.0})
      EXPECT_TRUE(same(hypotenuse(x, y), std::abs(x)) && same(hypotenuse(y, x), std::abs(x))) << x;
  EXPECT_TRUE(std::isnan(hypotenuse(std::numeric_limits<double>::quiet_NaN(), 1)));
}

/// Within two units in the last place: a root and an arctangent, each rounded.
TEST(Trigonometry, ArccosinesAndArcsinesAreThoseOfTheStandardLibraryButForTheirLastBits) {
  std::mt19937_64 random(6);
  std::uniform_real_distribution<double> share(-1, 1);
  std::vector<double> values = {1.0,    -1.0, 0.0, std::nextafter(1.0, 0.0), -std::nextafter(1.0, 0.0),
                                1e-300, 0.5};
  for (int i = 0; i < 5000; ++i) values.push_back(share(random));
  for (const double value : values) {
    const Long arc = acos(Long(value)), other = asin(Long(value));
    EXPECT_LE(abs(Long(arccosine(value)) - arc), abs(arc) * 0x1p-51) << value;
    EXPECT_LE(abs(Long(arcsine(value)) - other), abs(other) * 0x1p-51) << value;
  }
  EXPECT_TRUE(std::isnan(arccosine(1.5)) && std::isnan(arcsine(-1.5)));
}

TEST(Trigonometry, RotationsAreThoseOfEigenButForTheirLastBits) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> coordinate(-1, 1);
  for (int i = 0; i < 1000; ++i) {
    const Eigen::Vector3d axis =
        Eigen::Vector3d(coordinate(random), coordinate(random), coordinate(random)).normalized();
    const double angle = 10 * coordinate(random);
    const Eigen::Matrix3d expected = Eigen::AngleAxisd(angle, axis).toRotationMatrix();
    // Entries are sums of two products of numbers up to 1.
    EXPECT_LE((rotation_about(axis, angle) - expected).cwiseAbs().maxCoeff(), 0x1p-50) << angle;
  }
}

TEST(Trigonometry, ZerosInfinitiesAndWhatIsNoNumberAreAsInTheStandardLibrary) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double y : {0.0, -0.0, 1.0, -2.0, infinity, -infinity}) {
    for (const double x : {0.0, -0.0, 1.0, -2.0, infinity, -infinity})
      EXPECT_TRUE(y == x || y == -x || same(arctangent(y, x), std::atan2(y, x))) << y << ' ' << x;
  }
  EXPECT_TRUE(same(arctangent(0.0, -0.0), std::numbers::pi));
  EXPECT_TRUE(same(arctangent(-0.0, 0.0), -0.0));
  EXPECT_TRUE(std::isnan(arctangent(nan, 1)) && std::isnan(arctangent(1, nan)));
  EXPECT_TRUE(same(sine_cosine(-0.0).sine, -0.0));
  EXPECT_EQ(sine_cosine(0).cosine, 1);
  EXPECT_TRUE(std::isnan(sine_cosine(infinity).sine) && std::isnan(sine_cosine(nan).cosine));
  const volatile double huge =
      1e300;  // of a number the compiler would know the sine itself, and better than some libraries
  EXPECT_EQ(sine_cosine(huge).sine, std::sin(huge));
  const double least = std::numeric_limits<double>::denorm_min();
  EXPECT_EQ(sine_cosine(least).sine, least);
}

}  // namespace
}  // namespace condyle::core
