#include "tangential/build/profile_grid.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <random>
#include <set>
#include <vector>

#include "condyle/axis_frame.hpp"
#include "condyle/error.hpp"
#include "support/random_triangles.hpp"
#include "support/test_meshes.hpp"

namespace condyle {
namespace {

using Cells = std::set<std::size_t>;

Cells cells_of(const tangential::ProfileGrid& grid, const Vec3& a, const Vec3& b, const Vec3& c) {
  Cells cells;
  tangential::for_each_profile_run(grid, a, b, c, [&](Index row, Index first, Index last) {
    for (Index column = first; column <= last; ++column) cells.insert(grid.cell(row, column));
  });
  return cells;
}

tangential::ProfileGrid unit_cells(double rho_max, double z_min, double z_max) {
  tangential::ProfileGrid grid;
  grid.rho_max = rho_max, grid.z_min = z_min, grid.z_max = z_max;
  grid.columns = static_cast<Index>(rho_max), grid.rows = static_cast<Index>(z_max - z_min);
  return grid;
}

TEST(Profile, ATriangleAcrossTheAxisIsNearestInsideItsFaceNotAtItsCorners) {
  const auto grid = unit_cells(10, 0, 1);
  // All corners have rho > 4; the axis pierces the face: rho runs from 0 to the farthest corner.
  const auto cells = cells_of(grid, {5, 0, 0.5}, {-4, 4, 0.5}, {-4, -4, 0.5});
  EXPECT_EQ(cells, (Cells{0, 1, 2, 3, 4, 5}));
}

TEST(Profile, ATriangleBesideTheAxisIsNearestInsideAnEdge) {
  const auto grid = unit_cells(10, 0, 1);
  // The edge x = 3.5 passes the axis at 3.5, its ends and the third corner lie beyond 6.
  EXPECT_EQ(cells_of(grid, {3.5, -6, 0.5}, {3.5, 6, 0.5}, {7.2, 0, 0.5}), (Cells{3, 4, 5, 6, 7}));
}

TEST(Profile, EachRowHoldsOnlyTheRadiiOfItsOwnStrip) {
  const auto grid = unit_cells(10, 0, 3);
  // A radial needle from rho = 0.5 at z = 0.5 to rho = 6.5 at z = 2.5: slope 3 per row.
  const Vec3 low(0.5, 0, 0.5), high(6.5, 0, 2.5);
  std::vector<std::array<Index, 3>> runs;
  const auto record = [&](Index row, Index first, Index last) { runs.push_back({row, first, last}); };
  tangential::for_each_profile_run(grid, low, high, record);
  // Cuts at z = 1 and 2: rho = 2 and 5, on cell boundaries; rounding lists both neighbours.
  EXPECT_EQ(runs, (std::vector<std::array<Index, 3>>{{0, 0, 2}, {1, 1, 5}, {2, 4, 6}}));
}

TEST(Profile, ATriangleInAPlaneThroughTheAxisDoesNotReachIt) {
  const auto grid = unit_cells(10, 0, 1);
  EXPECT_EQ(cells_of(grid, {0, 4.5, 0.5}, {0, 6.5, 0.5}, {0, 5.5, 0.7}), (Cells{4, 5, 6}));
  const Vec3 radial(std::cos(1.0), std::sin(1.0), 0);
  EXPECT_EQ(cells_of(grid, 4.5 * radial + Vec3(0, 0, 0.5), 6.5 * radial + Vec3(0, 0, 0.5),
                     5.5 * radial + Vec3(0, 0, 0.7)),
            (Cells{4, 5, 6}));
}

TEST(Profile, WhatLiesBeyondTheGridIsLeftOut) {
  const auto grid = unit_cells(4, 0, 2);
  EXPECT_TRUE(cells_of(grid, {5, 0, 0.5}, {6, 1, 0.5}, {6, -1, 1.5}).empty());
  EXPECT_TRUE(cells_of(grid, {1, 0, 2.5}, {2, 1, 2.5}, {2, -1, 3.5}).empty());
  EXPECT_EQ(cells_of(grid, {3.5, 0, -1}, {3.5, 0, 3}, {9, 0, 1.5}), (Cells{3, 7}));
  EXPECT_FALSE(grid.cell_of(4.1, 1));
  EXPECT_FALSE(grid.cell_of(1, -0.1));
  EXPECT_EQ(grid.cell_of(4, 2), 7u);
}

TEST(Profile, EveryPointOfEveryTriangleFallsInAListedCell) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> weight(0, 1);
  for (const double shift : {0.0, 3.0, 1e4}) {
    const TriMesh mesh = test::triangles_of_all_sizes(random, shift, 1);
    // No triangle reaches further in from its corners than across: 2^1.5.
    tangential::ProfileGrid::Extent extent{1e9, 0, 1e9, -1e9};
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
      const Vec3 p = mesh.vertices[v];
      const double rho = tangential::axis_radius(p.x(), p.y());
      extent.rho_min = std::max(0.0, std::min(extent.rho_min, rho - 3)),
      extent.rho_max = std::max(extent.rho_max, rho);
      extent.z_min = std::min(extent.z_min, p.z()), extent.z_max = std::max(extent.z_max, p.z());
    }
    const auto grid = tangential::ProfileGrid::over(extent, 4096);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      const Vec3 a = mesh.corner(t, 0), b = mesh.corner(t, 1), c = mesh.corner(t, 2);
      const Cells cells = cells_of(grid, a, b, c);
      const auto listed = [&](const Vec3& p) {
        const auto cell = grid.cell_of(tangential::axis_radius(p.x(), p.y()), p.z());
        return cell && cells.contains(*cell);
      };
      EXPECT_TRUE(listed(a) && listed(b) && listed(c));
      for (int i = 0; i < 60; ++i) {
        double u = weight(random), v = weight(random);
        if (u + v > 1) u = 1 - u, v = 1 - v;
        EXPECT_TRUE(listed(a + u * (b - a) + v * (c - a))) << "triangle " << t << " shift " << shift;
      }
    }
  }
}

TEST(Profile, AListedCellIsMetUnlessByRounding) {
  // Not merely complete: each listed cell holds a sample of the triangle.
  const auto grid = unit_cells(8, 0, 8);
  const Vec3 a(1.3, -2.2, 0.4), b(-0.7, 5.1, 7.3), c(6.4, 1.9, 3.2);
  Cells met;
  constexpr int steps = 2000;
  for (int i = 0; i <= steps; ++i) {
    for (int j = 0; i + j <= steps; ++j) {
      const Vec3 p = a + (b - a) * (double(i) / steps) + (c - a) * (double(j) / steps);
      met.insert(*grid.cell_of(tangential::axis_radius(p.x(), p.y()), p.z()));
    }
  }
  EXPECT_EQ(cells_of(grid, a, b, c), met);
}

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
    const Eigen::AngleAxisd turn(0.8, n);
    const Vec3 turned = frame.to_axis(Vec3(turn * (p - point) + point));
    const Vec3 expected = Eigen::AngleAxisd(0.8, Vec3::UnitZ()) * frame.to_axis(p);
    // Rotations of a 12 mm arm: a handful of roundings of 12 * 2^-53 mm.
    EXPECT_LT((turned - expected).norm(), 32 * 12 * core::rounding_unit);
    EXPECT_LT((frame.from_axis(frame.to_axis(p)) - p).norm(), 32 * 12 * core::rounding_unit);
  }
}

TEST(AxisFrame, AnAxisWithoutDirectionIsRefused) {
  EXPECT_THROW(AxisFrame(Vec3::Zero(), Vec3::Zero()), UsageError);
  EXPECT_THROW(AxisFrame(Vec3(NAN, 0, 0), Vec3::UnitX()), UsageError);
}

}  // namespace
}  // namespace condyle
