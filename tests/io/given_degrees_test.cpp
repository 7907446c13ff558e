#include "io/joint/given_degrees.hpp"

#include <rapidcheck/gtest.h>

#include "support/test.hpp"

namespace condyle::io {
namespace {

TEST(GivenDegrees, AreThoseGivenAlsoWhereRadiansLoseTheLastDigit) {
  ASSERT_NE(Angle::degrees(30).degrees(), 30);
  for (int tenths = -3600; tenths <= 3600; ++tenths)
    EXPECT_EQ(given_degrees(Angle::degrees(tenths / 10.0)), tenths / 10.0);
}

RC_GTEST_PROP(GivenDegrees, AreThoseGivenForEveryDecimalOfFifteenDigits, ()) {
  const auto digits = *rc::gen::inRange<std::int64_t>(-999999999999999, 1000000000000000);
  const double degrees = static_cast<double>(digits) / 1e13;
  RC_ASSERT(given_degrees(Angle::degrees(degrees)) == degrees);
}

TEST(GivenDegrees, OfAnyOtherAngleAreItsOwn) {
  const Angle angle = Angle::radians(1.2345678901234567);
  EXPECT_EQ(Angle::degrees(given_degrees(angle)), angle);
  EXPECT_FALSE(std::signbit(given_degrees(Angle::degrees(-0.0))));
}

}  // namespace
}  // namespace condyle::io
