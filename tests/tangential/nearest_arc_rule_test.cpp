#include "condyle/tangential.hpp"

#include "support/test.hpp"
#include "tangential/about_z.hpp"

namespace condyle::tangential {
namespace {

using test::angle_error, test::on_circle, test::query_one, test::z_axis;

TEST(RingTable, TheNearestArcRuleFailsBeyondAPlaneMetTwiceAndTheDefaultDoesNot) {
  const TriMesh bar = test::box({-9, 2, -1}, {9, 3, 1});
  // The circle of (5, -8) first meets the end x = 9, 75 degrees ahead; it met the plane of that end once
  // before, at (9, -2.8), and so starts behind it: "inside", eleven millimetres from any solid.
  const Vec3 p(5, -8, 0.1);
  const double rho = std::sqrt(89), arc = std::acos(9 / rho) + std::atan2(8, 5);
  const auto published = query_one(bar, p, TangentialRule::nearest_arc), all = query_one(bar, p);
  EXPECT_EQ(published.state[0], PointState::inside);
  EXPECT_NEAR(published.angular_gap[0].radians(), -arc, angle_error(9, rho));
  EXPECT_EQ(all.state[0], PointState::outside);
  EXPECT_NEAR(all.angular_gap[0].radians(), arc, angle_error(9, rho));
  // The default is right everywhere about the same bar.
  Points points;
  std::vector<PointState> expected;
  for (double x = -9.85; x < 10; x += 0.3) {
    for (double y = -9.85; y < 10; y += 0.3) {
      points.push_back({x, y, 0.1});
      expected.push_back(std::abs(x) < 9 && y > 2 && y < 3 ? PointState::inside : PointState::outside);
    }
  }
  const RingTable table(bar, z_axis);
  EXPECT_EQ(table.query(points).state, expected);
  EXPECT_NE(table.query(points, TangentialRule::nearest_arc).state, expected);
}

TEST(RingTable, TheNearestArcRuleAgreesAwayFromEdgesAndUnderHalfATurn) {
  const TriMesh ball = test::sphere({12, 0, 0}, 5, 4);
  Points points;
  for (double degrees = -60; degrees <= 60; degrees += 1.7) {
    for (const double z : {-3.0, 0.1, 2.0}) points.push_back(on_circle(12, degrees, z));
  }
  const RingTable table(ball, z_axis);
  const auto nearest = table.query(points, TangentialRule::nearest_arc), all = table.query(points);
  EXPECT_EQ(nearest.state, all.state);
  EXPECT_EQ(nearest.angular_gap, all.angular_gap);
  EXPECT_EQ(nearest.rotation_sense, all.rotation_sense);
}

}  // namespace
}  // namespace condyle::tangential
