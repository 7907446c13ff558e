#include "tangential/build/profile_raster.hpp"

#include "support/random_triangles.hpp"
#include "support/test.hpp"

namespace condyle::tangential {
namespace {

using Cells = std::set<std::size_t>;

Cells cells_of(const ProfileGrid& grid, const Vec3& a, const Vec3& b, const Vec3& c) {
  Cells cells;
  tangential::for_each_profile_run(grid, a, b, c, [&](Index row, Index first, Index last) {
    for (Index column = first; column <= last; ++column) cells.insert(grid.cell(row, column));
  });
  return cells;
}

ProfileGrid unit_cells(double rho_max, double z_min, double z_max) {
  ProfileGrid grid;
  grid.rho_max = rho_max, grid.z_min = z_min, grid.z_max = z_max;
  grid.columns = static_cast<Index>(rho_max), grid.rows = static_cast<Index>(z_max - z_min);
  return grid;
}

TEST(ProfileRaster, ATriangleAcrossTheAxisIsNearestInsideItsFaceNotAtItsCorners) {
  const auto grid = unit_cells(10, 0, 1);
  // All corners have rho > 4; the axis pierces the face: rho runs from 0 to the farthest corner.
  const auto cells = cells_of(grid, {5, 0, 0.5}, {-4, 4, 0.5}, {-4, -4, 0.5});
  EXPECT_EQ(cells, (Cells{0, 1, 2, 3, 4, 5}));
}

TEST(ProfileRaster, ATriangleBesideTheAxisIsNearestInsideAnEdge) {
  const auto grid = unit_cells(10, 0, 1);
  // The edge x = 3.5 passes the axis at 3.5, its ends and the third corner lie beyond 6.
  EXPECT_EQ(cells_of(grid, {3.5, -6, 0.5}, {3.5, 6, 0.5}, {7.2, 0, 0.5}), (Cells{3, 4, 5, 6, 7}));
}

TEST(ProfileRaster, EachRowHoldsOnlyTheRadiiOfItsOwnStrip) {
  const auto grid = unit_cells(10, 0, 3);
  // A radial needle from rho = 0.5 at z = 0.5 to rho = 6.5 at z = 2.5: slope 3 per row.
  const Vec3 low(0.5, 0, 0.5), high(6.5, 0, 2.5);
  std::vector<std::array<Index, 3>> runs;
  const auto record = [&](Index row, Index first, Index last) { runs.push_back({row, first, last}); };
  tangential::for_each_profile_run(grid, low, high, high, record);
  // Cuts at z = 1 and 2: rho = 2 and 5, on cell boundaries; rounding gives both neighbours.
  EXPECT_EQ(runs, (std::vector<std::array<Index, 3>>{{0, 0, 2}, {1, 1, 5}, {2, 4, 6}}));
}

TEST(ProfileRaster, ATriangleInAPlaneThroughTheAxisDoesNotReachIt) {
  const auto grid = unit_cells(10, 0, 1);
  EXPECT_EQ(cells_of(grid, {0, 4.5, 0.5}, {0, 6.5, 0.5}, {0, 5.5, 0.7}), (Cells{4, 5, 6}));
  const Vec3 radial(std::cos(1.0), std::sin(1.0), 0);
  EXPECT_EQ(cells_of(grid, 4.5 * radial + Vec3(0, 0, 0.5), 6.5 * radial + Vec3(0, 0, 0.5),
                     5.5 * radial + Vec3(0, 0, 0.7)),
            (Cells{4, 5, 6}));
}

TEST(ProfileRaster, WhatLiesBeyondTheGridIsLeftOut) {
  const auto grid = unit_cells(4, 0, 2);
  EXPECT_TRUE(cells_of(grid, {5, 0, 0.5}, {6, 1, 0.5}, {6, -1, 1.5}).empty());
  EXPECT_TRUE(cells_of(grid, {1, 0, 2.5}, {2, 1, 2.5}, {2, -1, 3.5}).empty());
  EXPECT_EQ(cells_of(grid, {3.5, 0, -1}, {3.5, 0, 3}, {9, 0, 1.5}), (Cells{3, 7}));
  EXPECT_FALSE(grid.cell_of(4.1, 1));
  EXPECT_FALSE(grid.cell_of(1, -0.1));
  EXPECT_EQ(grid.cell_of(4, 2), 7u);
}

TEST(ProfileRaster, EveryPointOfEveryTriangleFallsInOneOfItsCells) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> weight(0, 1);
  for (const double shift : {0.0, 3.0, 1e4}) {
    const TriMesh mesh = test::triangles_of_all_sizes(random, shift, 1);
    // No triangle reaches further in from its corners than across: 2^1.5.
    ProfileGrid::Extent extent{1e9, 0, 1e9, -1e9};
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
      const Vec3 p = mesh.vertices[v];
      const double rho = tangential::axis_radius(p.x(), p.y());
      extent.rho_min = std::max(0.0, std::min(extent.rho_min, rho - 3)),
      extent.rho_max = std::max(extent.rho_max, rho);
      extent.z_min = std::min(extent.z_min, p.z()), extent.z_max = std::max(extent.z_max, p.z());
    }
    const auto grid = ProfileGrid::over(extent, 4096);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      const Vec3 a = mesh.corner(t, 0), b = mesh.corner(t, 1), c = mesh.corner(t, 2);
      const Cells cells = cells_of(grid, a, b, c);
      const auto found = [&](const Vec3& p) {
        const auto cell = grid.cell_of(tangential::axis_radius(p.x(), p.y()), p.z());
        return cell && cells.contains(*cell);
      };
      EXPECT_TRUE(found(a) && found(b) && found(c));
      for (int i = 0; i < 60; ++i) {
        double u = weight(random), v = weight(random);
        if (u + v > 1) u = 1 - u, v = 1 - v;
        EXPECT_TRUE(found(a + u * (b - a) + v * (c - a))) << "triangle " << t << " shift " << shift;
      }
    }
  }
}

TEST(ProfileRaster, ACellIsMetUnlessByRounding) {
  // Not merely complete: each cell holds a sample of the triangle.
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

}  // namespace
}  // namespace condyle::tangential
