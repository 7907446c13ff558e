#include "condyle/tangential.hpp"

#include "mesh/winding_number.hpp"
#include "support/test.hpp"
#include "tangential/about_z.hpp"
#include "tangential/circle_oracle.hpp"

namespace condyle::tangential {
namespace {

using test::angle_error, test::z_axis;

TEST(RingTable, BodiesThatShareAFaceHaveOneArc) {
  const TriMesh both = test::joined(test::box({0, 1, -1}, {2, 4, 1}), test::box({2, 1, -1}, {5, 4, 1}));
  Points points;
  points.push_back({2, -2, 0.25});
  // rho^2 = 8: from (sqrt 7, 1) by way of (2, 2), where one body is left and the other entered, to (1.., ..)
  // at x = 0.
  const auto arcs = RingTable(both, z_axis).occupied_arcs(points);
  ASSERT_EQ(arcs.of(0).size(), 1u);
  EXPECT_NEAR(arcs.of(0)[0].begin.radians(), two_pi / 8 + std::atan2(1, std::sqrt(7)),
              angle_error(5, std::sqrt(8)));
  EXPECT_NEAR(arcs.of(0)[0].end.radians(), two_pi / 8 + two_pi / 4, angle_error(5, std::sqrt(8)));
}

TEST(RingTable, OccupiedArcsAnswerEveryAngleAsRotatingThePointsDoes) {
  std::mt19937 random(31);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const TriMesh mesh = test::joined(test::sphere({12, 3, 0}, 9, 3), test::socket({-10, 2, 1}, 6, 9, 3));
  Points points;
  for (int i = 0; i < 120; ++i)
    points.push_back({20 * uniform(random), 20 * uniform(random), 9 * uniform(random)});
  const RingTable table(mesh, z_axis);
  const auto arcs = table.occupied_arcs(points);
  const mesh::WindingNumber winding(mesh);
  int inside = 0, compared = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (int degree = 0; degree < 360; ++degree) {
      const Angle phi = Angle::degrees(degree + 0.125);
      const Vec3 p = test::rotated(points[i], phi.radians());
      const auto gap = arcs.gap_at(i, phi);
      // A point rotated in double is off by 4u of 30 mm; only nearer than that to a crossing may the two
      // differ.
      if (std::abs(gap.angle.radians()) * std::hypot(p.x(), p.y()) < 1e-9) continue;
      EXPECT_EQ(gap.angle.radians() < 0, winding.at(p).state == PointState::inside);
      inside += gap.angle.radians() < 0;
      ++compared;
      // The table itself, queried with the rotated point, gives the same gap: ends move by the rounding of the
      // rotation, at a graze by its root.
      Points rotated_point;
      rotated_point.push_back(p);
      if (degree % 40 == 0) {
        const auto results = table.query(rotated_point);
        if (std::isinf(gap.angle.radians())) {
          EXPECT_EQ(results.angular_gap[0].radians(), gap.angle.radians());
        } else {
          EXPECT_NEAR(results.angular_gap[0].radians(), gap.angle.radians(), 1e-6);
        }
      }
    }
  }
  EXPECT_GT(inside, 3000);
  EXPECT_GT(compared, 120 * 360 - 100);
}

/// The circle of a point on the edge farthest from the axis touches the solid at the point, which rounding may put a turn ahead.
TEST(RingTable, AnArcThatBeginsAtThePointItselfIsLessThanATurnAhead) {
  const RingTable box(test::box({-4, -5, -6}, {4, 5, 6}), AxisFrame(Vec3::Zero(), Vec3::UnitZ()));
  for (const double x : {-4.0, 4.0}) {
    for (const double y : {-5.0, 5.0}) {
      Points corner;
      for (const double z : {-6.0, -1.0, 0.0, 3.3, 6.0}) corner.push_back({x, y, z});
      const OccupiedArcs arcs = box.occupied_arcs(corner);
      for (std::size_t i = 0; i < corner.size(); ++i) {
        for (const OccupiedArc& arc : arcs.of(i)) {
          EXPECT_GE(arc.begin.radians(), 0);
          EXPECT_LT(arc.begin.radians(), two_pi);
          EXPECT_LT(arc.begin.radians(), arc.end.radians());
          EXPECT_LT(arc.end.radians() - arc.begin.radians(), 1e-6);
        }
      }
    }
  }
}

TEST(RingTable, NestedBodiesAndCavitiesHaveTheArcsOfTheirUnion) {
  const TriMesh outer = test::sphere({12, 0, 0}, 6, 3), inner = test::sphere({12, 0, 0}, 3, 3);
  Points points;
  points.push_back({-12, 0, 0.1});
  points.push_back({12, 0.1, 0.1});
  const RingTable nested(test::joined(outer, inner), z_axis),
      shell(test::joined(outer, test::flipped(inner)), z_axis);
  EXPECT_EQ(nested.occupied_arcs(points).of(0).size(), 1u);
  EXPECT_EQ(shell.occupied_arcs(points).of(0).size(), 2u);
  EXPECT_EQ(nested.query(points).winding, (std::vector<int>{0, 2}));
  EXPECT_EQ(shell.query(points).winding, (std::vector<int>{0, 0}));
  EXPECT_GT(shell.query(points).angular_gap[1].radians(), 0);
  // With inverted orientation no point is inside, whatever the angle.
  const RingTable inverted(test::flipped(outer), z_axis);
  EXPECT_EQ(inverted.query(points).winding, (std::vector<int>{0, -1}));
  EXPECT_TRUE(inverted.occupied_arcs(points).of(1).empty());
}

}  // namespace
}  // namespace condyle::tangential
