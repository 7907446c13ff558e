#include "core/wrapped_angle.hpp"
#include "support/test.hpp"

namespace condyle {
namespace {

TEST(WrappedAngle, LiesInOneTurnAndNeverOnItsEnd) {
  EXPECT_EQ(core::wrapped(0), 0);
  EXPECT_EQ(core::wrapped(1), 1);
  EXPECT_EQ(core::wrapped(two_pi), 0);
  EXPECT_EQ(core::wrapped(-1), two_pi - 1);
  EXPECT_EQ(core::wrapped(std::nextafter(two_pi, 0)), std::nextafter(two_pi, 0));
  // -1e-300 + 2 pi rounds to 2 pi, which is 0.
  EXPECT_EQ(core::wrapped(-1e-300), 0);
  EXPECT_EQ(core::wrapped(-std::numeric_limits<double>::denorm_min()), 0);
}

TEST(WrappedAngle, OfAnySizeIsWhatFmodLeaves) {
  for (double angle = -1e6; angle < 1e6; angle += 12.34567) {
    const double rest = std::fmod(angle, two_pi);
    const double expected = rest < 0 ? rest + two_pi : rest;
    EXPECT_EQ(core::wrapped(angle), expected < two_pi ? expected : 0) << angle;
  }
}

}  // namespace
}  // namespace condyle
