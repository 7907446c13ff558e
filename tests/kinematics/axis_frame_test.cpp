#include "condyle/pose.hpp"

#include "core/predicates.hpp"
#include "support/test.hpp"

namespace condyle {
namespace {

TEST(AxisFrame, ACoordinateAxisOnlyPermutesAndNegatesCoordinates) {
  const Vec3 p(0.1, 0.7, 1e-17);
  for (int axis = 0; axis < 3; ++axis) {
    for (const double sense : {1.0, -0.3}) {
      const AxisFrame frame(Vec3::Zero(), sense * Vec3::Unit(axis));
      const Vec3 q = frame.to_axis(p);
      EXPECT_EQ(q.z(), sense > 0 ? p[axis] : -p[axis]);
      std::multiset<double> before{std::abs(p.x()), std::abs(p.y()), std::abs(p.z())};
      std::multiset<double> after{std::abs(q.x()), std::abs(q.y()), std::abs(q.z())};
      EXPECT_EQ(before, after);
      EXPECT_EQ(frame.from_axis(q), p);
      EXPECT_EQ(frame.direction(), Vec3(sense > 0 ? Vec3::Unit(axis) : Vec3(-Vec3::Unit(axis))));
    }
  }
}

TEST(AxisFrame, APositiveAngleIsRightHandedAboutTheDirectionGiven) {
  for (const Vec3& direction : {Vec3(1, 0, 0), Vec3(0, -2, 0), Vec3(0, 0, -1), Vec3(1, -2, 3)}) {
    const Vec3 point(4, 5, 6), n = direction.normalized();
    const AxisFrame frame(point, direction);
    const Vec3 p(9, -3, 7);
    const Eigen::AngleAxisd rotation(0.8, n);
    const Vec3 rotated = frame.to_axis(Vec3(rotation * (p - point) + point));
    const Vec3 expected = Eigen::AngleAxisd(0.8, Vec3::UnitZ()) * frame.to_axis(p);
    // Rotations of a 12 mm arm: a handful of roundings of 12 * 2^-53 mm.
    EXPECT_LT((rotated - expected).norm(), 32 * 12 * core::rounding_unit);
    EXPECT_LT((frame.from_axis(frame.to_axis(p)) - p).norm(), 32 * 12 * core::rounding_unit);
  }
}

TEST(AxisFrame, AnAxisWithoutDirectionIsRefused) {
  EXPECT_THROW(AxisFrame(Vec3::Zero(), Vec3::Zero()), UsageError);
  EXPECT_THROW(AxisFrame(Vec3(NAN, 0, 0), Vec3::UnitX()), UsageError);
}

}  // namespace
}  // namespace condyle
