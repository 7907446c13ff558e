#include "condyle/radial.hpp"

#include <boost/multiprecision/cpp_bin_float.hpp>

#include "core/thread_limit.hpp"
#include "mesh/subdivide.hpp"
#include "radial/penetration_cases.hpp"
#include "support/brute_force.hpp"
#include "support/test.hpp"

namespace condyle::radial {
namespace {

using test::box;
using test::flipped;
using test::joined;
using test::sphere;

constexpr double infinity = std::numeric_limits<double>::infinity();

class RadialTableOnMap : public testing::TestWithParam<DirectionMapKind> {
 protected:
  RadialTable table(const TriMesh& mesh, int cells_per_side = 16) const {
    return RadialTable(mesh, {GetParam(), cells_per_side});
  }
};

INSTANTIATE_TEST_SUITE_P(BothMaps, RadialTableOnMap,
                         testing::Values(DirectionMapKind::cartesian, DirectionMapKind::cube),
                         [](const auto& kind) {
                           return kind.param == DirectionMapKind::cube ? "cube" : "cartesian";
                         });

void expect_states_of_brute_force(const RadialTable& table, const Points& points) {
  const RadialResults hits = table.query(points);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto truth = test::winding_number(table.mesh(), points[i]);
    if (truth.on_surface) {
      EXPECT_EQ(hits.state[i], PointState::on_surface) << points[i].transpose();
    } else {
      EXPECT_EQ(hits.winding[i], truth.winding) << points[i].transpose();
      EXPECT_EQ(hits.state[i], truth.winding > 0 ? PointState::inside : PointState::outside)
          << points[i].transpose();
    }
  }
}

/// Fixed solid with a spherical cavity: a box wound outwards and a sphere wound inwards.
TriMesh cavity(const Vec3& centre, double radius, int levels) {
  return joined(box(centre.array() - 2 * radius, centre.array() + 2 * radius),
                flipped(sphere(centre, radius, levels)));
}

TEST_P(RadialTableOnMap, ConcentricBallInSocketHasTheClearanceAsGapEverywhere) {
  constexpr double socket = 25, ball = 24;
  const TriMesh mesh = cavity(Vec3::Zero(), socket, 4);
  const TriMesh mobile = sphere(Vec3::Zero(), ball, 3);
  const RadialResults hits = table(mesh).query(mobile.vertices);
  // Longest edge of the 4-level octasphere: a quarter turn in 16 parts, stretched at most by pi/2.
  const double edge = socket * std::numbers::pi / 2 / 16 * (std::numbers::pi / 2);
  const double sag = edge * edge / (8 * socket) * 2;  // at a triangle's middle, within twice that of an edge
  for (std::size_t i = 0; i < hits.size(); ++i) {
    EXPECT_EQ(hits.state[i], PointState::outside);
    EXPECT_LE(hits.radial_gap_mm[i], socket - ball + 1e-12);
    EXPECT_GE(hits.radial_gap_mm[i], socket - ball - sag);
    EXPECT_EQ(hits.direction[i], RayDirection::away_from_centre);
  }
}

TEST_P(RadialTableOnMap, ABallShiftedInItsSocketPenetratesWhereTheRaySphereRootSays) {
  constexpr double socket = 25, ball = 24.8, shift = 0.5;
  const Vec3 u = Vec3(1, 2, -2) / 3;
  const TriMesh mesh = cavity(Vec3::Zero(), socket, 5);
  const TriMesh mobile = sphere(shift * u, ball, 3);
  const RadialResults hits = table(mesh, 32).query(mobile.vertices);
  const double edge = socket * std::numbers::pi / 2 / 32 * (std::numbers::pi / 2);
  const double sag = edge * edge / (8 * socket) * 2;
  int inside = 0, outside = 0;
  for (std::size_t i = 0; i < hits.size(); ++i) {
    // |v| at angle alpha from u is the root of the shifted sphere: s cos + sqrt(r^2 - s^2 sin^2).
    const double cosine = mobile.vertices[i].normalized().dot(u);
    const double radius = shift * cosine + std::sqrt(ball * ball - shift * shift * (1 - cosine * cosine));
    const double gap = socket - radius;
    if (gap < -1e-12) {
      EXPECT_EQ(hits.state[i], PointState::inside);
      EXPECT_LE(hits.radial_gap_mm[i], gap + 1e-11);
      EXPECT_GE(hits.radial_gap_mm[i], gap - sag);
      EXPECT_EQ(hits.direction[i], RayDirection::towards_centre);
      ++inside;
    } else if (gap > sag) {
      EXPECT_EQ(hits.state[i], PointState::outside);
      EXPECT_LE(hits.radial_gap_mm[i], gap + 1e-11);
      EXPECT_GE(hits.radial_gap_mm[i], gap - sag);
      ++outside;
    }
  }
  EXPECT_GT(inside, 50);
  EXPECT_GT(outside, 50);
}

TEST_P(RadialTableOnMap, StatesAreThoseOfRationalArithmetic) {
  expect_states_of_brute_force(table(sphere({0.3, 0.2, -0.1}, 1, 2)), test::random_points(400, 1.5, 1));
  expect_states_of_brute_force(table(test::torus(2, 0.5, 12, 8)), test::random_points(400, 2.6, 2));
  expect_states_of_brute_force(table(test::socket({0.1, 0.05, -0.2}, 1, 1.3, 2)),
                               test::random_points(400, 1.5, 3));
}

TEST_P(RadialTableOnMap, RaysThroughVerticesAndEdgesAreCountedOnce) {
  // Every vertex and edge middle of these lies on an axis, a diagonal or a cell's border, and so do the query
  // rays.
  int compared = 0;
  for (const double factor : {0.5, 0.999999, 1.000001, 2.0}) {
    for (const TriMesh& mesh :
         {box({-1, -1, -1}, {1, 1, 1}), sphere(Vec3::Zero(), 1, 1), test::torus(2, 1, 8, 8)}) {
      if (test::winding_number(mesh, Vec3::Zero()).on_surface) continue;
      Points points;
      for (std::size_t i = 0; i < mesh.vertices.size(); ++i) points.push_back(factor * mesh.vertices[i]);
      for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        points.push_back(factor * 0.5 * (mesh.corner(t, 0) + mesh.corner(t, 1)));
      }
      expect_states_of_brute_force(table(mesh, 8), points);
      ++compared;
    }
  }
  EXPECT_EQ(compared, 12);
}

TEST_P(RadialTableOnMap, PointsExactlyOnTheSurfaceAreOnIt) {
  const TriMesh mesh = box({-1, -2, -1}, {3, 2, 1});
  Points points;
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) points.push_back(mesh.vertices[i]);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    points.push_back(0.5 * (mesh.corner(t, 0) + mesh.corner(t, 1)));
    points.push_back(0.25 * mesh.corner(t, 0) + 0.25 * mesh.corner(t, 1) + 0.5 * mesh.corner(t, 2));
  }
  const RadialResults hits = table(mesh).query(points);
  for (std::size_t i = 0; i < hits.size(); ++i) {
    EXPECT_EQ(hits.state[i], PointState::on_surface) << points[i].transpose();
    EXPECT_EQ(hits.radial_gap_mm[i], 0);
    EXPECT_NE(hits.triangle[i], no_index);
  }
}

TEST_P(RadialTableOnMap, PointsOnTheSilhouetteAreOnTheSurface) {
  // A box whose face lies in a plane through the centre, seen edge-on: no ray crosses that face, yet it is
  // surface.
  const TriMesh mesh = box({1, 0, -1}, {3, 2, 1});
  Points points;
  points.push_back({2, 0, 0});
  points.push_back({1, 0, 0});
  points.push_back({3, 0, 1});
  points.push_back({1, 1, 1});
  const RadialResults hits = table(mesh).query(points);
  for (const PointState state : hits.state) EXPECT_EQ(state, PointState::on_surface);
  expect_states_of_brute_force(table(mesh), test::random_points(300, 3.5, 4));
}

TEST_P(RadialTableOnMap, SeveralSolidsAlongOneRayAreToldApart) {
  TriMesh mesh = box({1, -1, -1}, {2, 1, 1});
  mesh = joined(mesh, box({3, -1, -1}, {4, 1, 1}));
  mesh = joined(mesh, box({3.5, -1, -1}, {5, 1, 1}));
  Points points;
  for (const double x : {0.5, 1.25, 1.75, 2.5, 3.25, 3.75, 4.75, 6.0}) points.push_back({x, 0.01, 0.02});
  const RadialResults hits = table(mesh).query(points);
  EXPECT_EQ(hits.winding, (std::vector<int>{0, 1, 1, 0, 1, 2, 1, 0}));
  const double stretch = points[0].norm() / 0.5;  // the ray is not quite along x: path per unit of x
  const auto at = [&](std::size_t i) { return hits.radial_gap_mm[i]; };
  const auto along = [&](std::size_t i) { return points[i].norm() / points[i].x(); };
  EXPECT_NEAR(at(0), 0.5 * stretch, 1e-14);
  EXPECT_NEAR(at(1), -0.25 * along(1), 1e-14);
  EXPECT_EQ(hits.direction[1], RayDirection::towards_centre);
  EXPECT_NEAR(at(2), -0.25 * along(2), 1e-14);
  EXPECT_EQ(hits.direction[2], RayDirection::away_from_centre);
  EXPECT_NEAR(at(3), 0.5 * along(3), 1e-14);
  // Where two solids overlap, the exit passes the boundary inside: that of their union counts.
  EXPECT_NEAR(at(5), -0.75 * along(5), 1e-14);
  EXPECT_NEAR(at(6), -0.25 * along(6), 1e-14);
  EXPECT_EQ(at(7), infinity);
  EXPECT_EQ(hits.triangle[7], no_index);
  expect_states_of_brute_force(table(mesh), test::random_points(300, 5.5, 5));
}

TEST_P(RadialTableOnMap, ASolidThatHoldsTheCentreMeasuresGapsInwards) {
  const RadialTable solid = table(sphere(Vec3::Zero(), 10, 4));
  EXPECT_EQ(solid.winding_at_centre(), 1);
  Points points;
  points.push_back({12, 0, 0});  // along a vertex: the true radius
  points.push_back({0, 9, 0});
  points.push_back({0, 0, 0});
  const RadialResults hits = solid.query(points);
  EXPECT_EQ(hits.state[0], PointState::outside);
  EXPECT_NEAR(hits.radial_gap_mm[0], 2, 1e-14);
  EXPECT_EQ(hits.direction[0], RayDirection::towards_centre);
  EXPECT_EQ(hits.state[1], PointState::inside);
  EXPECT_NEAR(hits.radial_gap_mm[1], -1, 1e-14);
  EXPECT_EQ(hits.direction[1], RayDirection::away_from_centre);
  EXPECT_EQ(hits.state[2], PointState::inside);
  EXPECT_EQ(hits.radial_gap_mm[2], -infinity);
}

TEST_P(RadialTableOnMap, DepthsAreThoseOfAnIndependentRayInFiftyDigits) {
  using Fifty = boost::multiprecision::cpp_bin_float_50;
  const TriMesh mesh = sphere({0.4, -0.3, 0.2}, 1, 3);
  const Points points = test::random_points(2000, 1.3, 7);
  const RadialResults hits = table(mesh).query(points);
  EXPECT_LT(std::count(hits.triangle.begin(), hits.triangle.end(), no_index), 100);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (hits.triangle[i] == no_index) continue;
    std::array<std::array<Fifty, 3>, 4> p;  // corners a b c, then the query point
    for (int k = 0; k < 3; ++k) {
      for (int corner = 0; corner < 3; ++corner) p[corner][k] = mesh.corner(hits.triangle[i], corner)[k];
      p[3][k] = points[i][k];
    }
    std::array<Fifty, 3> n;
    for (int k = 0; k < 3; ++k) {
      const int l = (k + 1) % 3, m = (k + 2) % 3;
      n[k] = (p[1][l] - p[0][l]) * (p[2][m] - p[0][m]) - (p[1][m] - p[0][m]) * (p[2][l] - p[0][l]);
    }
    const auto dot = [](const auto& a, const auto& b) {
      return Fifty(a[0] * b[0] + a[1] * b[1] + a[2] * b[2]);
    };
    const Fifty distance = (dot(n, p[0]) / dot(n, p[3]) - 1) * sqrt(dot(p[3], p[3]));
    const double expected = abs(distance).convert_to<double>();
    EXPECT_NEAR(std::abs(hits.radial_gap_mm[i]), expected, 1e-12 * points[i].norm());
  }
}

TEST_P(RadialTableOnMap, TurningMeshAndPointsTogetherChangesNothingBeyondRounding) {
  TriMesh mesh = sphere({0.4, -0.3, 0.2}, 1, 3);
  const Points points = test::random_points(2000, 1.3, 8);
  Pose X = Pose::Identity();
  X.linear() = Eigen::AngleAxisd(0.7, Vec3(1, -2, 0.5).normalized()).toRotationMatrix();
  const RadialResults still = table(mesh).query(points),
                      turned = table(posed(X, mesh)).query(posed(X, points.view()));
  // Posing moves a coordinate by at most 4u of its size; no random point is that near to a surface or to an
  // edge's ray, and a gap moves by that over the cosine between ray and normal.
  EXPECT_EQ(still.state, turned.state);
  EXPECT_EQ(still.triangle, turned.triangle);
  EXPECT_LT(std::count(still.triangle.begin(), still.triangle.end(), no_index), 100);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (still.triangle[i] == no_index) continue;
    const double moved = 16 * 0x1p-53 * 1.5 / std::cos(still.ray_to_normal[i].radians());
    EXPECT_NEAR(still.radial_gap_mm[i], turned.radial_gap_mm[i], moved * 2);
  }
}

TEST_P(RadialTableOnMap, RefiningTheMeshWithoutMovingItsSurfaceChangesNoAnswer) {
  // Corners at multiples of 1/64: the midpoints of two refinements are exact.
  TriMesh mesh = sphere({0.375, -0.25, 0.125}, 1, 2);
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    mesh.vertices.set(i, (mesh.vertices[i] * 64).array().round() / 64);
  }
  const Points points = test::random_points(2000, 1.3, 12);
  const RadialResults coarse = table(mesh).query(points),
                      fine = table(mesh::subdivided(mesh::subdivided(mesh))).query(points);
  EXPECT_EQ(coarse.state, fine.state);
  EXPECT_EQ(coarse.winding, fine.winding);
  EXPECT_LT(std::count(coarse.triangle.begin(), coarse.triangle.end(), no_index), 100);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (coarse.triangle[i] == no_index) continue;
    EXPECT_NEAR(coarse.radial_gap_mm[i], fine.radial_gap_mm[i], 2e-12 * points[i].norm());
  }
}

TEST_P(RadialTableOnMap, OneThreadAndManyGiveTheSameBytes) {
  const RadialTable solid = table(sphere({0.4, -0.3, 0.2}, 1, 4));
  const Points points = test::random_points(20000, 1.3, 9);
  RadialResults one, many;
  {
    const core::ThreadLimit single(1);
    solid.query(points, one);
  }
  {
    const core::ThreadLimit eight(8);
    solid.query(points, many);
  }
  EXPECT_EQ(one, many);
}

TEST_P(RadialTableOnMap, AnOpenMeshIsRefusedByNameOfItsBoundary) {
  TriMesh mesh = sphere({0.1, 0, 0}, 1, 1);
  mesh.triangles.pop_back();
  const RadialTable open = table(mesh);
  EXPECT_FALSE(open.is_closed());
  try {
    open.query(mesh.vertices);
    FAIL() << "an open mesh has no inside";
  } catch (const MeshError& error) {
    EXPECT_NE(std::string(error.what()).find("edge from vertex"), std::string::npos) << error.what();
  }
}

TEST_P(RadialTableOnMap, ACentreOnTheSurfaceIsRefusedByNameOfItsTriangle) {
  EXPECT_THROW(table(box({0, -1, -1}, {2, 1, 1})), MeshError);  // in a face
  EXPECT_THROW(table(box({0, 0, -1}, {2, 1, 1})), MeshError);   // on an edge
  EXPECT_THROW(table(box({0, 0, 0}, {2, 1, 1})), MeshError);    // on a vertex
  EXPECT_NO_THROW(table(box({0, 0.5, 0}, {2, 1, 1})));          // in the plane of faces, not on them
}

TEST_P(RadialTableOnMap, AMeshOfInvertedOrientationHasNegativeWindingAndNoInside) {
  const RadialResults hits =
      table(flipped(sphere({0.1, 0.2, 0.3}, 1, 2))).query(test::random_points(200, 0.3, 10));
  for (const int winding : hits.winding) EXPECT_EQ(winding, -1);
}

TEST(RadialTable, BothMapsGiveTheSameBytes) {
  const TriMesh mesh = test::socket({0.1, 0.05, -0.2}, 1, 1.3, 3);
  const Points points = test::random_points(3000, 1.5, 11);
  EXPECT_EQ(RadialTable(mesh, {DirectionMapKind::cube, 24}).query(points),
            RadialTable(mesh, {DirectionMapKind::cartesian, 40}).query(points));
}

// The table of the paper's map keeps nothing in floats, so every answer of it is exact arithmetic's.
TEST(RadialTable, WhatFloatsTellIsWhatExactArithmeticTells) {
  std::mt19937_64 random(17);
  for (const double scale : {1e-27, 1e-11, 1.0, 1e11, 1e27}) {
    SCOPED_TRACE(scale);
    for (TriMesh mesh : {test::socket({0.1, 0.05, -0.2}, 1, 1.3, 3), test::torus(0.8, 0.5, 30, 20)}) {
      for (std::size_t i = 0; i < mesh.vertices.size(); ++i) mesh.vertices.set(i, scale * mesh.vertices[i]);
      Points points = test::random_points(2000, 1.5 * scale, 13);
      // Rays through vertices and edges, or nearly, and points on the surface, or nearly.
      for (const Triangle& corners : mesh.triangles) {
        const Vec3 a = mesh.vertices[corners[0]], b = mesh.vertices[corners[1]],
                   c = mesh.vertices[corners[2]];
        for (const Vec3& at : {a, Vec3((a + b) / 2), Vec3((a + b + c) / 3)}) {
          for (const double along : {0.7, 1 - 1e-7, 1.0, 1 + 1e-9, 1.4}) {
            const double off = std::uniform_real_distribution(-1.0, 1.0)(random);
            points.push_back(along * at);
            points.push_back(along * at + 1e-8 * off * (c - b));
          }
        }
      }
      const RadialResults rough = RadialTable(mesh, {DirectionMapKind::cube, 24}).query(points);
      EXPECT_EQ(rough, RadialTable(mesh, {DirectionMapKind::cartesian, 24}).query(points));
      EXPECT_GT(std::count(rough.state.begin(), rough.state.end(), PointState::inside), 1000);
      EXPECT_GT(std::count(rough.state.begin(), rough.state.end(), PointState::on_surface), 100);
    }
  }
}

TEST_P(RadialTableOnMap, GapsAloneAreThoseOfQueries) {
  const RadialTable socket = table(test::socket({0.1, 0.05, -0.2}, 1, 1.3, 3));
  Points points = test::random_points(1000, 1.5, 12);
  points.push_back(Vec3::Zero());
  EXPECT_EQ(socket.radial_gaps(points), socket.query(points).radial_gap_mm);
  EXPECT_TRUE(socket.radial_gaps(Points()).empty());

  TriMesh open = sphere({0, 0, 0}, 1, 2);
  open.triangles.pop_back();
  EXPECT_THROW(table(open).radial_gaps(points), MeshError);
  points.push_back({std::numeric_limits<double>::quiet_NaN(), 0, 0});
  EXPECT_THROW(socket.radial_gaps(points), UsageError);
}

TEST(RadialTable, TheAngleBetweenRayAndNormalTellsWhereRadialDepthMeansSomething) {
  const RadialTable table(box({-10, -10, 5}, {10, 10, 6}));
  Points points;
  points.push_back({0, 0, 5.5});
  points.push_back({9, 0, 5.1});
  const RadialResults hits = table.query(points);
  EXPECT_NEAR(hits.ray_to_normal[0].radians(), 0, 1e-15);
  EXPECT_NEAR(hits.ray_to_normal[1].radians(), std::atan2(9.0, 5.1), 1e-15);
  EXPECT_GT(hits.ray_to_normal[1], oblique_ray);
}

// Strips round a tube, seen from the centre some times longer than a cell: smaller cells would have entries as the power 3/2 of the triangles.
TEST(RadialTable, SlenderTrianglesHaveEntriesInProportion) {
  const auto entries = [](int around) {
    return RadialTable(test::torus(5, 2, around, 10)).table_size().entries;
  };
  EXPECT_LE(entries(4 * 8'000), 5 * entries(8'000));
}

TEST(RadialTable, CellsOutOfRangeAreRefused) {
  EXPECT_THROW(RadialTable(sphere({0, 0, 0}, 1, 0), {DirectionMapKind::cube, 0}), UsageError);
  EXPECT_THROW(RadialTable(sphere({0, 0, 0}, 1, 0), {DirectionMapKind::cube, 1 << 20}), UsageError);
}

}  // namespace
}  // namespace condyle::radial
