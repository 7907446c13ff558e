#include "condyle/tangential/ring_table.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "condyle/core/error.hpp"
#include "condyle/core/instruction_set.hpp"
#include "support/test_meshes.hpp"
#include "tangential/circle_oracle.hpp"

namespace condyle {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

const AxisFrame z_axis(Vec3::Zero(), Vec3::UnitZ());

TangentialHits query_one(const TriMesh& mesh, const Vec3& p,
                         TangentialRule rule = TangentialRule::alternating) {
  Points points;
  points.push_back(p);
  return RingTable(mesh, z_axis).query(points, rule);
}

Vec3 on_circle(double rho, double degrees, double z) {
  const double angle = Angle::degrees(degrees).radians();
  return {rho * std::cos(angle), rho * std::sin(angle), z};
}

/// Bound for the angle of a crossing of meshes within `scale` of the axis, not touching: ends off by 17u
/// scale, a point given with 2u of its radius, crossing at no less than 30 degrees.
double angle_error(double scale, double rho) {
  return 2 * 19 * rounding_unit * scale / rho + 8 * rounding_unit;
}

/// Against the obvious version: every piece of every circle, and every end of an arc at a place where the
/// surface is.
void expect_same_as_oracle(const TriMesh& mesh, const Points& points) {
  const RingTable table(mesh, z_axis);
  const auto arcs = table.occupied_arcs(points);
  const auto hits = table.query(points);
  const auto windings = WindingNumber(mesh).at(points);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec3 p = points[i];
    EXPECT_EQ(hits.state[i], windings[i].state) << p.transpose();
    if (windings[i].state != PointState::on_surface) {
      EXPECT_EQ(hits.winding[i], windings[i].winding);
    }
    if (p.x() == 0 && p.y() == 0) continue;
    const auto pieces = test::circle_pieces(mesh, p);
    for (const auto& piece : pieces) {
      if (piece.end - piece.begin < 1e-3) continue;
      const double middle = (piece.begin + piece.end) / 2;
      EXPECT_EQ(arcs.inside_at(i, Angle::radians(middle)), piece.winding > 0)
          << "point " << p.transpose() << " turned by " << middle;
    }
    for (const auto& arc : arcs.of(i)) {
      for (const double end : {arc.begin, arc.end}) {
        if (arc.enters == no_index) continue;
        double nearest = infinity;
        for (const auto& piece : pieces) {
          nearest = std::min(nearest, std::abs(std::remainder(end - piece.begin, two_pi)));
        }
        // The oracle's circle is 1e-10 smaller: a touch moves by sqrt(2e-10 / rho) with rho no less than 0.1.
        EXPECT_LT(nearest, 5e-5) << "point " << p.transpose();
      }
    }
  }
}

TEST(RingTable, ABoxHingedOnItsEdgeIsMetAtArctangents) {
  // x in [0, 8], y in [0, 3], hinged on the z axis: at rho = 5 it holds angles from 0 to asin(3/5) =
  // atan(3/4).
  const TriMesh door = test::box({0, 0, -1}, {8, 3, 1});
  const double far_end = std::atan2(3, 4), error = angle_error(8, 5);
  struct Case {
    double degrees, gap;
    Turn turn;
  };
  const double degree = Angle::degrees(1).radians();
  for (const auto& [degrees, gap, turn] :
       {Case{-20, 20 * degree, Turn::positive}, Case{60, 60 * degree - far_end, Turn::negative},
        Case{10, -10 * degree, Turn::negative}, Case{30, 30 * degree - far_end, Turn::positive},
        Case{-160, 160 * degree, Turn::positive}, Case{160, 160 * degree - far_end, Turn::negative}}) {
    const auto hits = query_one(door, on_circle(5, degrees, 0.25));
    EXPECT_NEAR(hits.angular_gap[0], gap, error) << degrees;
    EXPECT_NEAR(hits.arc_gap[0], 5 * gap, 5 * error) << degrees;
    EXPECT_EQ(hits.turn[0], turn) << degrees;
    EXPECT_EQ(hits.state[0], gap < 0 ? PointState::inside : PointState::outside);
    EXPECT_NE(hits.triangle[0], no_index);
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
      for (const double reach : {std::numbers::pi - arc.begin, arc.end - std::numbers::pi}) {
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
  const auto hits = table.query(points);
  const auto arcs = table.occupied_arcs(points);
  EXPECT_GT(std::count(inside.begin(), inside.end(), true), 400);
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_EQ(hits.angular_gap[i], inside[i] ? -infinity : infinity);
    EXPECT_EQ(hits.arc_gap[i], hits.angular_gap[i]);
    EXPECT_EQ(hits.triangle[i], no_index);
    ASSERT_EQ(arcs.of(i).size(), inside[i] ? 1u : 0u);
    if (inside[i]) {
      EXPECT_EQ(arcs.of(i)[0], (OccupiedArc{0, two_pi, no_index, no_index}));
    }
    EXPECT_EQ(arcs.inside_at(i, Angle::degrees(77)), inside[i]);
  }
}

TEST(RingTable, ASlabNearerInsideItsFaceThanAnyOfItsVerticesIsFound) {
  // The face x = 3.5 passes the axis at 3.5; every vertex is beyond 6.9. At rho = 4 it holds |angle| <
  // acos(3.5 / 4).
  const TriMesh slab = test::box({3.5, -6, -6}, {9, 6, 6});
  const auto hits = query_one(slab, on_circle(4, 90, 0.5));
  EXPECT_NEAR(hits.angular_gap[0], two_pi / 4 - std::acos(3.5 / 4), angle_error(9, 4));
  EXPECT_EQ(query_one(slab, on_circle(4, 0, 0.5)).state[0], PointState::inside);
}

TEST(RingTable, ABoxPiercedByTheAxisIsSolidNearItAndHasFourCornersFurtherOut) {
  const TriMesh box = test::box({-5, -5, -5}, {5, 5, 5});
  EXPECT_EQ(query_one(box, {0, 0, 1}).angular_gap[0], -infinity);
  EXPECT_EQ(query_one(box, {0, 0, 1}).state[0], PointState::inside);
  EXPECT_EQ(query_one(box, {0, 0, 6}).angular_gap[0], infinity);
  EXPECT_EQ(query_one(box, {0, 0, 5}).state[0], PointState::on_surface);
  EXPECT_EQ(query_one(box, on_circle(4.9, 33, 4)).angular_gap[0], -infinity);
  Points points;
  points.push_back(on_circle(6, 45, 4));
  const auto arcs = RingTable(box, z_axis).occupied_arcs(points);
  ASSERT_EQ(arcs.of(0).size(), 4u);
  const double half = two_pi / 8 - std::acos(5.0 / 6);
  const auto gap = arcs.gap_at(0, Angle::degrees(45));
  EXPECT_NEAR(gap.angle, two_pi / 8 - half, angle_error(5, 6));
  EXPECT_NEAR(arcs.gap_at(0, Angle::degrees(360 + 90 + 2)).angle, -(half - Angle::degrees(2).radians()),
              angle_error(5, 6));
  EXPECT_EQ(arcs.gap_at(0, Angle::degrees(-268)).turn, Turn::positive);
}

TEST(RingTable, ACircleThatTouchesAFaceOrAnEdgeDoesNotEnter) {
  const TriMesh box = test::box({3, -4, -1}, {5, 4, 1});
  for (const double z : {-1.0, -0.5, 0.0, 1.0}) {
    // At rho = 3 the circle touches the face at one point, in a lattice position; just beyond it crosses
    // twice.
    EXPECT_EQ(query_one(box, {-3, 0, z}).angular_gap[0], infinity) << z;
    EXPECT_EQ(query_one(box, {3, 0, z}).state[0], PointState::on_surface) << z;
  }
  const double beyond = std::nextafter(3, 4);
  const auto hits = query_one(box, {-beyond, 0, 0.25});
  // One crossing each side of angle pi, off by at most sqrt(2 e / rho), e = 17u * 5 mm and the one step in
  // rho.
  EXPECT_NEAR(hits.angular_gap[0], std::numbers::pi, std::sqrt(2 * (17 * 5 * rounding_unit + 0x1p-51) / 3));
  EXPECT_EQ(hits.work.crossings, 2u);
  EXPECT_GT(hits.work.exact_decisions, 0u);
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
    EXPECT_LT(inside.angular_gap[0], 0);
    EXPECT_GT(inside.angular_gap[0], -angle_error(3, 2));
    EXPECT_EQ(inside.turn[0], Turn::negative);
  }
}

TEST(RingTable, APointOnAFaceButForRoundingIsAsNearToItFromEitherSide) {
  // Rounded onto the faces, points fall to either side by less than the crossing's angle is known: which
  // side, the exact signs tell. Were one wrong, the whole circle would seem solid, or empty.
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
  const auto hits = RingTable(ball, z_axis).query(points);
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_LT(std::abs(hits.angular_gap[i]), 2 * angle_error(19, axis_radius(points[i].x(), points[i].y())));
  }
  EXPECT_GT(std::count(hits.state.begin(), hits.state.end(), PointState::inside), 500);
  EXPECT_GT(std::count(hits.state.begin(), hits.state.end(), PointState::outside), 500);
}

TEST(RingTable, CirclesThroughVerticesAlongEdgesAndWithinFacesAreThoseOfAllTriangles) {
  Points lattice;
  for (int x = -5; x <= 5; ++x) {
    for (int y = -5; y <= 5; ++y) {
      for (const double z : {-2.0, -1.0, 0.0, 0.5, 1.0, 2.0}) lattice.push_back({double(x), double(y), z});
    }
  }
  // Radius 5 passes through (3, 4), (4, 3), (5, 0): on corners and edges of these.
  expect_same_as_oracle(test::box({3, -4, -1}, {5, 4, 1}), lattice);
  expect_same_as_oracle(test::joined(test::box({0, 0, -1}, {4, 3, 1}), test::box({-5, 0, -2}, {0, 3, 2})),
                        lattice);
  // Two boxes that share a face: one arc through both.
  expect_same_as_oracle(test::joined(test::box({0, 1, -1}, {2, 4, 1}), test::box({2, 1, -1}, {5, 4, 1})),
                        lattice);
  expect_same_as_oracle(test::sphere({3, 0, 0}, 2, 1), lattice);
}

TEST(RingTable, TouchingBodiesShareOneArc) {
  const TriMesh both = test::joined(test::box({0, 1, -1}, {2, 4, 1}), test::box({2, 1, -1}, {5, 4, 1}));
  Points points;
  points.push_back({2, -2, 0.25});
  // rho^2 = 8: from (sqrt 7, 1) by way of (2, 2), where one body is left and the other entered, to (1.., ..)
  // at x = 0.
  const auto arcs = RingTable(both, z_axis).occupied_arcs(points);
  ASSERT_EQ(arcs.of(0).size(), 1u);
  EXPECT_NEAR(arcs.of(0)[0].begin, two_pi / 8 + std::atan2(1, std::sqrt(7)), angle_error(5, std::sqrt(8)));
  EXPECT_NEAR(arcs.of(0)[0].end, two_pi / 8 + two_pi / 4, angle_error(5, std::sqrt(8)));
}

TriMesh tangle(std::mt19937& random, Index bodies) {
  std::uniform_int_distribution<int> coordinate(-4, 4);
  TriMesh mesh;
  for (Index i = 0; i < bodies; ++i) {
    for (int k = 0; k < 4; ++k) {
      mesh.vertices.push_back(Vec3(coordinate(random), coordinate(random), coordinate(random)));
    }
    const Index v = 4 * i;
    mesh.triangles.insert(mesh.triangles.end(),
                          {{v, v + 2, v + 1}, {v, v + 1, v + 3}, {v + 1, v + 2, v + 3}, {v + 2, v, v + 3}});
  }
  return mesh;
}

TEST(RingTable, ARandomTangleOnALatticeIsMetAsByAllTriangles) {
  // Self-intersecting, touching, coplanar, degenerate, both senses, through the axis.
  std::mt19937 random(17);
  std::uniform_int_distribution<int> coordinate(-5, 5);
  for (int round = 0; round < 12; ++round) {
    const TriMesh mesh = tangle(random, 6);
    Points points;
    for (int i = 0; i < 30; ++i) {
      const double finer = i % 2 ? 1 : 0.5;
      points.push_back(finer * Vec3(coordinate(random), coordinate(random), coordinate(random)));
    }
    expect_same_as_oracle(mesh, points);
  }
}

TEST(RingTable, CrossingsOfAClosedMeshSumToZeroAndComeBackToTheAnchor) {
  // Over all triangles, no table: entries and exits, on meshes made to hit every tie.
  std::mt19937 random(23);
  std::uniform_int_distribution<int> coordinate(-5, 5);
  std::size_t crossings = 0, exact = 0;
  for (int round = 0; round < 200; ++round) {
    const TriMesh mesh = tangle(random, 8);
    for (int i = 0; i < 20; ++i) {
      const Vec3 p(coordinate(random), coordinate(random), coordinate(random));
      if (p.x() == 0 && p.y() == 0) continue;
      const Circle circle{p, p.x() * p.x() + p.y() * p.y(), 5};
      std::vector<CircleCrossing> all;
      TangentialWork work;
      int sum = 0, outwards = 0;
      for (Index t = 0; t < mesh.triangles.size(); ++t) {
        const Vec3 a = mesh.corner(t, 0), b = mesh.corner(t, 1), c = mesh.corner(t, 2);
        const TriangleRef corners = {&a, &b, &c};
        add_crossings(circle, corners, t, all, work);
        outwards += outward_crossing(circle, corners, work);
      }
      for (const auto& crossing : all) sum += static_cast<int>(crossing.passage);
      EXPECT_EQ(sum, 0);
      // The ray outwards is a second, independent way to the winding number.
      const auto winding = WindingNumber(mesh).at(p);
      if (winding.state != PointState::on_surface) {
        EXPECT_EQ(outwards, winding.winding);
      }
      crossings += all.size(), exact += work.exact_decisions;
    }
  }
  EXPECT_GT(crossings, 5000u);
  EXPECT_GT(exact, 5000u);
}

/// Each triangle split in four at the middles of its edges: on a lattice of whole numbers exactly the same
/// surface.
TriMesh refined(const TriMesh& mesh) {
  TriMesh out{mesh.vertices, {}};
  std::map<std::pair<Index, Index>, Index> middles;
  const auto middle = [&](Index a, Index b) {
    const auto [at, is_new] = middles.try_emplace(std::minmax(a, b), static_cast<Index>(out.vertices.size()));
    if (is_new) out.vertices.push_back((mesh.vertices[a] + mesh.vertices[b]) / 2);
    return at->second;
  };
  for (const auto& [a, b, c] : mesh.triangles) {
    const Index ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    out.triangles.insert(out.triangles.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
  }
  return out;
}

TEST(RingTable, RefiningAMeshWithoutMovingItsSurfaceChangesNoGap) {
  std::mt19937 random(41);
  std::uniform_int_distribution<int> coordinate(-4096, 4096);
  std::size_t finite = 0;
  for (int round = 0; round < 20; ++round) {
    // Binary fractions, so that two refinements are exact.
    const auto point = [&]() -> Vec3 {
      return Vec3(coordinate(random), coordinate(random), coordinate(random)) / 1024;
    };
    TriMesh mesh = tangle(random, 5);
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v) mesh.vertices.set(v, point());
    const TriMesh finer = refined(refined(mesh));
    Points points;
    for (int i = 0; i < 40; ++i) points.push_back(point());
    // At the heights of the finer mesh's vertices, but not through them: a circle that touches the solid in
    // one point only has an arc of no length there, and rounding tells whether it shows.
    for (std::size_t v = 0; v < finer.vertices.size(); v += 3) {
      const Vec3 p = finer.vertices[v];
      points.push_back({p.x(), 1, p.z()});
      points.push_back({0.3, p.y(), p.z()});
    }
    const auto before = RingTable(mesh, z_axis).query(points), after = RingTable(finer, z_axis).query(points);
    EXPECT_EQ(before.state, after.state);
    EXPECT_EQ(before.winding, after.winding);
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (std::isinf(before.angular_gap[i])) {
        EXPECT_EQ(before.angular_gap[i], after.angular_gap[i]);
        continue;
      }
      // Each errs by at most sqrt(2 e / rho), were it a touch: e = 17u * 4 mm * sqrt 2.
      const double rho = axis_radius(points[i].x(), points[i].y());
      EXPECT_NEAR(before.angular_gap[i], after.angular_gap[i],
                  2 * std::sqrt(2 * 17 * 6 * rounding_unit / rho));
      ++finite;
    }
  }
  EXPECT_GT(finite, 1000u);
}

TEST(RingTable, ASheetOfNoThicknessHoldsNothing) {
  TriMesh sheet;
  sheet.vertices.push_back({1, 1, -1}), sheet.vertices.push_back({4, 1, -1}),
      sheet.vertices.push_back({2, 1, 3});
  sheet.triangles = {{0, 1, 2}, {0, 2, 1}};
  const auto hits = query_one(sheet, {0, 2.5, 0});
  EXPECT_EQ(hits.work.crossings, 2u);
  EXPECT_EQ(hits.angular_gap[0], infinity);
  EXPECT_EQ(query_one(sheet, {2, 1, 0}).state[0], PointState::on_surface);
}

TEST(RingTable, OccupiedArcsAnswerEveryAngleAsTurningThePointsDoes) {
  std::mt19937 random(31);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const TriMesh mesh = test::joined(test::sphere({12, 3, 0}, 9, 3), test::socket({-10, 2, 1}, 6, 9, 3));
  Points points;
  for (int i = 0; i < 120; ++i)
    points.push_back({20 * uniform(random), 20 * uniform(random), 9 * uniform(random)});
  const RingTable table(mesh, z_axis);
  const auto arcs = table.occupied_arcs(points);
  const WindingNumber winding(mesh);
  int inside = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (int degree = 0; degree < 360; ++degree) {
      const Angle phi = Angle::degrees(degree + 0.125);
      const Vec3 p = test::turned(points[i], phi.radians());
      const auto gap = arcs.gap_at(i, phi);
      // A point turned in double is off by 4u of 30 mm; only nearer than that to a crossing may the two
      // differ.
      if (std::abs(gap.angle) * std::hypot(p.x(), p.y()) < 1e-9) continue;
      EXPECT_EQ(gap.angle < 0, winding.at(p).state == PointState::inside);
      inside += gap.angle < 0;
      // The table itself, asked about the turned point, gives the same gap: ends move by the rounding of the
      // turn, at a graze by its root.
      Points turned_point;
      turned_point.push_back(p);
      if (degree % 40 == 0) {
        const auto hits = table.query(turned_point);
        if (std::isinf(gap.angle)) {
          EXPECT_EQ(hits.angular_gap[0], gap.angle);
        } else {
          EXPECT_NEAR(hits.angular_gap[0], gap.angle, 1e-6);
        }
      }
    }
  }
  EXPECT_GT(inside, 3000);
}

TEST(RingTable, TheNearestArcRuleFailsBeyondAPlaneMetTwiceAndTheDefaultDoesNot) {
  const TriMesh bar = test::box({-9, 2, -1}, {9, 3, 1});
  // The circle of (5, -8) first meets the end x = 9, 75 degrees ahead; it met the plane of that end once
  // before, at (9, -2.8), and so starts behind it: "inside", eleven millimetres from any solid.
  const Vec3 p(5, -8, 0.1);
  const double rho = std::sqrt(89), arc = std::acos(9 / rho) + std::atan2(8, 5);
  const auto published = query_one(bar, p, TangentialRule::nearest_arc), all = query_one(bar, p);
  EXPECT_EQ(published.state[0], PointState::inside);
  EXPECT_NEAR(published.angular_gap[0], -arc, angle_error(9, rho));
  EXPECT_EQ(all.state[0], PointState::outside);
  EXPECT_NEAR(all.angular_gap[0], arc, angle_error(9, rho));
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
  EXPECT_EQ(nearest.turn, all.turn);
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
  EXPECT_GT(shell.query(points).angular_gap[1], 0);
  // Wound inside out there is nobody inside, whatever the angle.
  const RingTable inverted(test::flipped(outer), z_axis);
  EXPECT_EQ(inverted.query(points).winding, (std::vector<int>{0, -1}));
  EXPECT_TRUE(inverted.occupied_arcs(points).of(1).empty());
}

TEST(RingTable, TenMetresFromTheOriginStatesStayExactAndAnglesKeepTheirBound) {
  const Vec3 away(1e4, -1e4, 1e4);
  const TriMesh ball = test::sphere(away, 25, 3);
  Points points;
  for (std::size_t i = 0; i < ball.vertices.size(); ++i) {
    const Vec3 v = ball.vertices[i];
    points.push_back(v);
    points.push_back(v + (away - v) * 1e-12);
    points.push_back(v + (away - v) * 0.3);
    points.push_back(v - (away - v) * 0.3);
  }
  const auto windings = WindingNumber(ball).at(points);
  // About the z axis of the origin, 14 m away: no rounding at all.
  const auto hits = RingTable(ball, z_axis).query(points);
  for (std::size_t i = 0; i < points.size(); ++i) EXPECT_EQ(hits.state[i], windings[i].state);
  // About an axis beside the ball, the coordinates rounded once: the angle is that of the mesh moved to the
  // origin.
  const TriMesh home = test::sphere(Vec3::Zero(), 25, 3);
  Points home_points;
  for (std::size_t i = 0; i < points.size(); ++i) home_points.push_back(points[i] - away);
  const auto far_hits = RingTable(ball, AxisFrame(away + Vec3(40, 0, 0), Vec3::UnitZ())).query(points);
  const auto near_hits = RingTable(home, AxisFrame(Vec3(40, 0, 0), Vec3::UnitZ())).query(home_points);
  for (std::size_t i = 2; i < points.size(); i += 4) {
    // Vertices ten metres out are given to 2^-40 mm; at a graze that may show as its root.
    EXPECT_EQ(far_hits.state[i], near_hits.state[i]);
    EXPECT_NEAR(far_hits.angular_gap[i], near_hits.angular_gap[i], std::sqrt(2 * 0x1p-39 / 15));
  }
}

TEST(RingTable, AnyAxisGivesWhatTurningEverythingToZGives) {
  const Vec3 point(3, -2, 5), direction(1, -2, 3);
  const AxisFrame frame(point, direction);
  const TriMesh mesh = test::socket({10, 4, -3}, 8, 12, 3);
  Points points, in_frame;
  std::mt19937 random(2);
  std::uniform_real_distribution<double> uniform(-15, 15);
  for (int i = 0; i < 500; ++i) {
    points.push_back(Vec3(10, 4, -3) + Vec3(uniform(random), uniform(random), uniform(random)));
    in_frame.push_back(frame.to_axis(points[points.size() - 1]));
  }
  EXPECT_EQ(RingTable(mesh, frame).query(points), RingTable(frame.to_axis(mesh), z_axis).query(in_frame));
  // Opposite direction: the same gaps, every turn reversed.
  const auto forth = RingTable(mesh, AxisFrame(Vec3::Zero(), Vec3::UnitX())).query(points);
  const auto back = RingTable(mesh, AxisFrame(Vec3::Zero(), -Vec3::UnitX())).query(points);
  EXPECT_EQ(forth.state, back.state);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (std::isinf(forth.angular_gap[i])) {
      EXPECT_EQ(forth.angular_gap[i], back.angular_gap[i]);
    } else {
      EXPECT_NEAR(forth.angular_gap[i], back.angular_gap[i], 1e-7);
      EXPECT_EQ(static_cast<int>(forth.turn[i]), -static_cast<int>(back.turn[i]));
    }
  }
}

TEST(RingTable, AnOpenMeshAndAFoolishOptionAreRefused) {
  TriMesh mesh = test::box({1, 1, 1}, {2, 2, 2});
  EXPECT_THROW(RingTable(mesh, z_axis, {.cells_per_triangle = 0}), UsageError);
  EXPECT_THROW(RingTable(mesh, z_axis, {.cells_per_triangle = NAN}), UsageError);
  mesh.triangles.pop_back();
  try {
    RingTable refused(mesh, z_axis);
    FAIL() << "an open mesh was accepted";
  } catch (const MeshError& error) {
    EXPECT_NE(std::string(error.what()).find("intersecting triangle pairs can still be computed"),
              std::string::npos);
  }
}

TEST(RingTable, AMeshCheckedBeforeGivesTheSameTable) {
  const TriMesh mesh = test::torus(8, 3, 20, 10);
  Points points;
  for (double x = -12; x < 12; x += 0.7) points.push_back({x, 1.3, 0.4});
  const ClosedMesh closed(mesh);
  EXPECT_EQ(RingTable(closed, z_axis).query(points), RingTable(mesh, z_axis).query(points));
  EXPECT_EQ(RingTable(ClosedMesh::known(mesh), z_axis).query(points), RingTable(mesh, z_axis).query(points));
}

TEST(RingTable, NoTrianglesAndNoPointsAreNoTrouble) {
  const RingTable nothing(TriMesh{}, z_axis);
  Points points;
  EXPECT_EQ(nothing.query(points).size(), 0u);
  EXPECT_EQ(nothing.occupied_arcs(points).size(), 0u);
  points.push_back({1, 2, 3}), points.push_back({0, 0, 0});
  EXPECT_EQ(nothing.query(points).angular_gap, (std::vector<double>{infinity, infinity}));
  EXPECT_TRUE(nothing.occupied_arcs(points).of(1).empty());
}

TEST(RingTable, AnyFinenessOfTheProfileGivesTheSameAnswersByteForByte) {
  const TriMesh mesh = test::joined(test::torus(8, 3, 31, 17), test::sphere({6, 2, 1}, 4, 3));
  Points points;
  std::mt19937 random(12);
  std::uniform_real_distribution<double> uniform(-12, 12);
  for (int i = 0; i < 3000; ++i) points.push_back({uniform(random), uniform(random), uniform(random) / 3});
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) points.push_back(mesh.vertices[i]);
  const RingTable coarse(mesh, z_axis, {.cells_per_triangle = 0.001}),
      fine(mesh, z_axis, {.cells_per_triangle = 8});
  auto a = coarse.query(points), b = fine.query(points);
  EXPECT_GT(a.work.candidates, 3 * b.work.candidates);
  a.work = b.work = {};
  EXPECT_EQ(a, b);
  EXPECT_EQ(coarse.occupied_arcs(points), fine.occupied_arcs(points));
}

TEST(RingTable, IsTheSameOnEveryInstructionSetByteForByte) {
  const TriMesh mesh = test::joined(test::torus(8, 3, 50, 30), test::socket({3, 2, 0}, 6, 8, 3));
  Points points;
  std::mt19937 random(14);
  std::uniform_real_distribution<double> uniform(-12, 12);
  for (int i = 0; i < 5000; ++i) points.push_back({uniform(random), uniform(random), uniform(random) / 2});
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) points.push_back(mesh.vertices[i]);
  const AxisFrame frame(Vec3(0.3, -0.2, 0), Vec3(1, 2, 7));
  for (const AxisFrame& axis : {z_axis, frame}) {
    const RingTable table(mesh, axis);
    const auto hits = table.query(points);
    const auto arcs = table.occupied_arcs(points);
    EXPECT_GT(std::count(hits.state.begin(), hits.state.end(), PointState::inside), 500);
    for (const InstructionSet& set : instruction_sets()) {
      const InstructionSetInUse in_use(set);
      EXPECT_EQ(hits, RingTable(mesh, axis).query(points)) << set.name;
      EXPECT_EQ(arcs, RingTable(mesh, axis).occupied_arcs(points)) << set.name;
      EXPECT_EQ(hits, table.query(points)) << set.name;
    }
  }
}

TEST(RingTable, IsTheSameForAnyNumberOfThreadsByteForByte) {
  const TriMesh mesh = test::joined(test::torus(8, 3, 50, 30), test::socket({3, 2, 0}, 6, 8, 3));
  Points points;
  std::mt19937 random(4);
  std::uniform_real_distribution<double> uniform(-12, 12);
  for (int i = 0; i < 20000; ++i) points.push_back({uniform(random), uniform(random), uniform(random) / 2});
  const RingTable table(mesh, z_axis);
  const auto hits = table.query(points);
  const auto arcs = table.occupied_arcs(points);
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  EXPECT_EQ(hits, RingTable(mesh, z_axis).query(points));
  EXPECT_EQ(arcs, RingTable(mesh, z_axis).occupied_arcs(points));
  EXPECT_GT(std::count(hits.state.begin(), hits.state.end(), PointState::inside), 2000);
}

}  // namespace
}  // namespace condyle
