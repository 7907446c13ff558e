#include "condyle/tangential.hpp"

#include "support/test.hpp"
#include "tangential/about_z.hpp"

namespace condyle::tangential {
namespace {

using test::angle_error, test::infinity, test::on_circle, test::query_one, test::z_axis;

TEST(RingTable, ABoxHingedOnItsEdgeIsMetAtArctangents) {
  // x in [0, 8], y in [0, 3], hinged on the z axis: at rho = 5 it holds angles from 0 to asin(3/5) =
  // atan(3/4).
  const TriMesh door = test::box({0, 0, -1}, {8, 3, 1});
  const double far_end = std::atan2(3, 4), error = angle_error(8, 5);
  struct Case {
    double degrees, gap;
    RotationSense sense;
  };
  const double degree = Angle::degrees(1).radians();
  for (const auto& [degrees, gap, sense] : {Case{-20, 20 * degree, RotationSense::positive},
                                            Case{60, 60 * degree - far_end, RotationSense::negative},
                                            Case{10, -10 * degree, RotationSense::negative},
                                            Case{30, 30 * degree - far_end, RotationSense::positive},
                                            Case{-160, 160 * degree, RotationSense::positive},
                                            Case{160, 160 * degree - far_end, RotationSense::negative}}) {
    const auto results = query_one(door, on_circle(5, degrees, 0.25));
    EXPECT_NEAR(results.angular_gap[0].radians(), gap, error) << degrees;
    EXPECT_NEAR(results.arc_gap_mm[0], 5 * gap, 5 * error) << degrees;
    EXPECT_EQ(results.rotation_sense[0], sense) << degrees;
    EXPECT_EQ(results.state[0], gap < 0 ? PointState::inside : PointState::outside);
    EXPECT_NE(results.triangle[0], no_index);
  }
}

TEST(RingTable, AnOffAxisSphereIsMetBetweenItsSagAndItsRadius) {
  const double radius = 10, offset = 25;
  const int levels = 5;
  const TriMesh ball = test::sphere({offset, 0, 0}, radius, levels);
  double edge = 0;
  for (std::size_t t = 0; t < ball.triangles.size(); ++t) {
    for (int k = 0; k < 3; ++k)
      edge = std::max(edge, (ball.corner(t, k) - ball.corner(t, (k + 1) % 3)).norm());
  }
  // A chord sags by edge^2 / (8 r), a face by at most 4/3 of that: the circumradius of a triangle is at most
  // edge / sqrt(3) where it is not obtuse.
  const double sag = edge * edge / (6 * radius);
  Points points;
  for (const double rho : {17.0, 20.0, 25.0, 30.0, 33.0}) {
    for (const double z : {-5.0, -1.0, 0.0, 2.5, 6.0}) points.push_back({-rho, 0, z});
  }
  const auto arcs = RingTable(ball, z_axis).occupied_arcs(points);
  int met = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double rho = -points[i].x(), z = points[i].z();
    // |(rho cos t - d, rho sin t, z)| = r.
    const auto half = [&](double r) {
      return std::acos(
          std::clamp((rho * rho + offset * offset + z * z - r * r) / (2 * rho * offset), -1.0, 1.0));
    };
    const double most = half(radius), least = half(radius - sag);
    if (least > 0) {
      ASSERT_EQ(arcs.of(i).size(), 1u);
    }
    if (most == 0) {
      EXPECT_TRUE(arcs.of(i).empty());
    }
    for (const auto& arc : arcs.of(i)) {
      ++met;
      for (const double reach :
           {std::numbers::pi - arc.begin.radians(), arc.end.radians() - std::numbers::pi}) {
        EXPECT_GE(reach, least - 1e-12);
        EXPECT_LE(reach, most + 1e-12);
      }
    }
  }
  EXPECT_GT(met, 15);
}

TEST(RingTable, ABodyOfRevolutionMeetsNoCircleOrAWholeOne) {
  const double major = 20, minor = 6;
  const int around = 90, across = 40;
  const TriMesh ring = test::torus(major, minor, around, across);
  // Chords around the axis pass inside by (R + r)(1 - cos(pi / around)), chords across by r (1 - cos(pi /
  // across)).
  const double sag = (major + minor) * (1 - std::cos(std::numbers::pi / around)) +
                     minor * (1 - std::cos(std::numbers::pi / across));
  Points points;
  std::vector<bool> inside;
  for (double rho = 10; rho < 30; rho += 0.37) {
    for (double z = -8; z < 8; z += 0.41) {
      const double from_ring = std::hypot(rho - major, z);
      if (std::abs(from_ring - minor) <= sag) continue;
      points.push_back(on_circle(rho, 100 * z, z));
      inside.push_back(from_ring < minor);
    }
  }
  const RingTable table(ring, z_axis);
  const auto results = table.query(points);
  const auto arcs = table.occupied_arcs(points);
  EXPECT_GT(std::count(inside.begin(), inside.end(), true), 400);
  EXPECT_GT(points.size(), 2100u);
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_EQ(results.angular_gap[i].radians(), inside[i] ? -infinity : infinity);
    EXPECT_EQ(results.arc_gap_mm[i], results.angular_gap[i].radians());
    EXPECT_EQ(results.triangle[i], no_index);
    ASSERT_EQ(arcs.of(i).size(), inside[i] ? 1u : 0u);
    if (inside[i]) {
      EXPECT_EQ(arcs.of(i)[0], (OccupiedArc{Angle(), Angle::radians(two_pi), no_index, no_index}));
    }
    EXPECT_EQ(arcs.inside_at(i, Angle::degrees(77)), inside[i]);
  }
}

TEST(RingTable, ASlabNearerInsideItsFaceThanAnyOfItsVerticesIsFound) {
  // The face x = 3.5 passes the axis at 3.5; every vertex is beyond 6.9. At rho = 4 it holds |angle| <
  // acos(3.5 / 4).
  const TriMesh slab = test::box({3.5, -6, -6}, {9, 6, 6});
  const auto results = query_one(slab, on_circle(4, 90, 0.5));
  EXPECT_NEAR(results.angular_gap[0].radians(), two_pi / 4 - std::acos(3.5 / 4), angle_error(9, 4));
  EXPECT_EQ(query_one(slab, on_circle(4, 0, 0.5)).state[0], PointState::inside);
}

TEST(RingTable, ABoxPiercedByTheAxisIsSolidNearItAndHasFourCornersFurtherOut) {
  const TriMesh box = test::box({-5, -5, -5}, {5, 5, 5});
  EXPECT_EQ(query_one(box, {0, 0, 1}).angular_gap[0].radians(), -infinity);
  EXPECT_EQ(query_one(box, {0, 0, 1}).state[0], PointState::inside);
  EXPECT_EQ(query_one(box, {0, 0, 6}).angular_gap[0].radians(), infinity);
  EXPECT_EQ(query_one(box, {0, 0, 5}).state[0], PointState::on_surface);
  EXPECT_EQ(query_one(box, on_circle(4.9, 33, 4)).angular_gap[0].radians(), -infinity);
  Points points;
  points.push_back(on_circle(6, 45, 4));
  const auto arcs = RingTable(box, z_axis).occupied_arcs(points);
  ASSERT_EQ(arcs.of(0).size(), 4u);
  const double half = two_pi / 8 - std::acos(5.0 / 6);
  const auto gap = arcs.gap_at(0, Angle::degrees(45));
  EXPECT_NEAR(gap.angle.radians(), two_pi / 8 - half, angle_error(5, 6));
  EXPECT_NEAR(arcs.gap_at(0, Angle::degrees(360 + 90 + 2)).angle.radians(),
              -(half - Angle::degrees(2).radians()), angle_error(5, 6));
  EXPECT_EQ(arcs.gap_at(0, Angle::degrees(-268)).rotation_sense, RotationSense::positive);
}

TEST(RingTable, ACircleThatTouchesAFaceOrAnEdgeDoesNotEnter) {
  const TriMesh box = test::box({3, -4, -1}, {5, 4, 1});
  for (const double z : {-1.0, -0.5, 0.0, 1.0}) {
    // At rho = 3 the circle touches the face at one point, in a lattice position; just beyond it crosses
    // twice.
    EXPECT_EQ(query_one(box, {-3, 0, z}).angular_gap[0].radians(), infinity) << z;
    EXPECT_EQ(query_one(box, {3, 0, z}).state[0], PointState::on_surface) << z;
  }
  const double beyond = std::nextafter(3, 4);
  const auto results = query_one(box, {-beyond, 0, 0.25});
  // One crossing each side of angle pi, off by at most sqrt(2 e / rho), e = 17u * 5 mm and the one step in
  // rho.
  EXPECT_NEAR(results.angular_gap[0].radians(), std::numbers::pi,
              std::sqrt(2 * (17 * 5 * core::rounding_unit + 0x1p-51) / 3));
  EXPECT_EQ(results.work.crossings, 2u);
  EXPECT_GT(results.work.exact_decisions, 0u);
  EXPECT_EQ(query_one(box, {beyond, 0, 0.25}).state[0], PointState::inside);
  // rho = 5 through the edges (3, +-4): from inside the disc they are outside, like the edge (5, 0) within a
  // face.
  EXPECT_EQ(query_one(box, {-5, 0, 0.25}).state[0], PointState::outside);
}

TEST(RingTable, OneUnitInTheLastPlaceDecidesTheState) {
  const TriMesh wedge = test::box({1, 1, -1}, {3, 2, 1});
  for (const double z : {-0.5, 0.0, 0.75}) {
    EXPECT_EQ(query_one(wedge, {2, std::nextafter(1, 0), z}).state[0], PointState::outside);
    EXPECT_EQ(query_one(wedge, {2, 1, z}).state[0], PointState::on_surface);
    const auto inside = query_one(wedge, {2, std::nextafter(1, 2), z});
    EXPECT_EQ(inside.state[0], PointState::inside);
    EXPECT_LT(inside.angular_gap[0].radians(), 0);
    EXPECT_GT(inside.angular_gap[0].radians(), -angle_error(3, 2));
    EXPECT_EQ(inside.rotation_sense[0], RotationSense::negative);
  }
}

TEST(RingTable, APointOnAFaceButForRoundingIsAsNearToItFromEitherSide) {
  // Rounded onto the faces, points fall to either side by less than the crossing's angle is known: which
  // side, the exact signs decide. Were one wrong, the whole circle would seem solid, or empty.
  const TriMesh ball = test::sphere({12, 3, 1}, 7, 3);
  std::mt19937 random(19);
  std::uniform_real_distribution<double> weight(0, 0.5);
  Points points;
  for (std::size_t t = 0; t < ball.triangles.size(); ++t) {
    const Vec3 a = ball.corner(t, 0), b = ball.corner(t, 1), c = ball.corner(t, 2);
    const Vec3 normal = (b - a).cross(c - a).normalized();
    for (int i = 0; i < 20; ++i) {
      const Vec3 p = a + weight(random) * (b - a) + weight(random) * (c - a);
      // Crossed at no less than 30 degrees.
      if (std::abs(normal.dot(Vec3(-p.y(), p.x(), 0).normalized())) > 0.5) points.push_back(p);
    }
  }
  const auto results = RingTable(ball, z_axis).query(points);
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_LT(std::abs(results.angular_gap[i].radians()),
              2 * angle_error(19, tangential::axis_radius(points[i].x(), points[i].y())));
  }
  EXPECT_GT(std::count(results.state.begin(), results.state.end(), PointState::inside), 500);
  EXPECT_GT(std::count(results.state.begin(), results.state.end(), PointState::outside), 500);
}

TEST(RingTable, ASheetOfNoThicknessHoldsNothing) {
  TriMesh sheet;
  sheet.vertices.push_back({1, 1, -1}), sheet.vertices.push_back({4, 1, -1}),
      sheet.vertices.push_back({2, 1, 3});
  sheet.triangles = {{0, 1, 2}, {0, 2, 1}};
  const auto results = query_one(sheet, {0, 2.5, 0});
  EXPECT_EQ(results.work.crossings, 2u);
  EXPECT_EQ(results.angular_gap[0].radians(), infinity);
  EXPECT_EQ(query_one(sheet, {2, 1, 0}).state[0], PointState::on_surface);
}

}  // namespace
}  // namespace condyle::tangential
