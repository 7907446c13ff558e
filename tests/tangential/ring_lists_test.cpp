#include "tangential/build/ring_lists.hpp"

#include "simd/instruction_set.hpp"
#include "support/random_triangles.hpp"
#include "support/test.hpp"
#include "tangential/build/box_cells.hpp"
#include "tangential/query/circle_cells.hpp"
#include "tangential/query/gather_candidates.hpp"

namespace condyle::tangential {
namespace {

const AxisFrame about_z_axis(Vec3::Zero(), Vec3::UnitZ());

struct Listed {
  AxisVertices vertices;
  ProfileBoxes boxes;
  RingLists lists;
};

Listed listed(const TriMesh& mesh, std::size_t cells) {
  Listed out;
  out.vertices = tangential::vertices_in_axis_frame(mesh.vertices, about_z_axis);
  out.boxes = tangential::profile_boxes(out.vertices.rounded, mesh.triangles);
  out.lists = RingLists(out.vertices, mesh.triangles, out.boxes, cells);
  return out;
}

/// Cells that floats cannot distinguish: of a needle about the axis, and of points in it.
TEST(RingLists, ABoxIsWithinTheGridWhereItsCellsAreNoFloats) {
  const TriMesh needle = test::box({-1e-29, -3e-29, -1e10}, {5e-29, 6e-29, 1e10});
  const TriMesh in_the_axis = test::box({0, 0, -1e-30}, {0, 0, 1e-30});
  for (const TriMesh& mesh : {needle, in_the_axis}) {
    for (const std::size_t cells : {1u, 12u, 400u}) {
      const Listed here = listed(mesh, cells);
      const ProfileGrid& grid = here.lists.grid();
      const BoxScale scale(grid, here.vertices.units_per_mm);
      for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const BoxSides sides = scale.sides(here.boxes, t);
        EXPECT_LE(sides.first_column(), sides.last_column());
        EXPECT_LE(sides.first_row(), sides.last_row());
        EXPECT_LT(sides.last_column(), grid.columns);
        EXPECT_LT(sides.last_row(), grid.rows);
      }
    }
  }
}

TEST(RingLists, TheCircleOfEveryPointOfATriangleFindsIt) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> weight(0, 1);
  for (const double scale : {1.0, 1e-9, 1e12, 1e-30, 1e30, 1e150}) {
    for (const double shift : {0.0, 3.0, 1e4}) {
      const TriMesh mesh = test::triangles_of_all_sizes(random, shift, scale);
      for (const std::size_t cells : {1u, 64u, 4096u}) {
        const RingLists lists = listed(mesh, cells).lists;
        Points points;
        std::vector<Index> expected;
        for (Index t = 0; t < mesh.triangles.size(); ++t) {
          const Vec3 a = mesh.corner(t, 0), b = mesh.corner(t, 1), c = mesh.corner(t, 2);
          for (int i = 0; i < 20; ++i) {
            double u = i == 0 ? 0 : weight(random), v = i < 2 ? 0 : weight(random);
            if (u + v > 1) u = 1 - u, v = 1 - v;
            const Vec3 p = a + u * (b - a) + v * (c - a);
            points.push_back(p), expected.push_back(t);
          }
        }
        LocatedCircles circles;
        tangential::locate_circles(about_z_axis, lists.grid(), points, circles);
        ASSERT_EQ(circles.size(), points.size()) << "shift " << shift << " scale " << scale;
        CandidatePairs pairs;
        std::set<std::pair<Index, Index>> found;
        for (std::size_t done = 0; done < circles.size();) {
          done = gather_candidates(lists, circles.cell, done, pairs);
          for (std::size_t k = 0; k < pairs.circle.size(); ++k)
            EXPECT_TRUE(found.emplace(pairs.circle[k], pairs.triangle[k]).second);
        }
        for (Index i = 0; i < circles.size(); ++i)
          EXPECT_TRUE(found.contains({i, expected[i]})) << "triangle " << expected[i] << " shift " << shift;
      }
    }
  }
}

/// On a real size of triangles boxes are tight: of those that hold a circle, the triangle's own heights and
/// radii hold it too, but for 256ths of a cell and what a triangle may come nearer than its corners.
TEST(RingLists, ABoxIsNoWiderThanItsTriangleByMoreThanTwoPartsOfACell) {
  const TriMesh mesh = test::sphere({60, 3, 1}, 20, 5);
  const Listed all = listed(mesh, mesh.triangles.size() / 8);
  const ProfileGrid& grid = all.lists.grid();
  std::mt19937 random(6);
  std::uniform_real_distribution<double> weight(0, 1);
  std::size_t compared = 0;
  for (int i = 0; i < 2000; ++i) {
    const double rho = grid.rho_min + weight(random) * (grid.rho_max - grid.rho_min);
    const double z = grid.z_min + weight(random) * (grid.z_max - grid.z_min);
    Points point;
    point.push_back({rho, 0, z});
    LocatedCircles circle;
    tangential::locate_circles(about_z_axis, grid, point, circle);
    ASSERT_EQ(circle.size(), 1u);
    CandidatePairs pairs;
    gather_candidates(all.lists, circle.cell, 0, pairs);
    for (const Index t : pairs.triangle) {
      double low = 1e9, high = 0, z_low = 1e9, z_high = -1e9, longest2 = 0;
      for (int k = 0; k < 3; ++k) {
        const Vec3 p = mesh.corner(t, k), q = mesh.corner(t, (k + 1) % 3);
        const double radius = tangential::axis_radius(p.x(), p.y());
        low = std::min(low, radius), high = std::max(high, radius);
        z_low = std::min(z_low, p.z()), z_high = std::max(z_high, p.z());
        longest2 = std::max(longest2, (p - q).squaredNorm());
      }
      // The sides of the extent in x and y are L at most each: squares fall short by 2 L^2 / 3, radii, L
      // being a thirtieth of them, by that over 2 * 2.9 / 3 of the radius.
      const double sag = longest2 / (2.9 * low), parts = 2.0 / 256;
      EXPECT_GE(rho, low - sag - parts * grid.rho_cell);
      EXPECT_LE(rho, high + parts * grid.rho_cell);
      EXPECT_GE(z, z_low - parts * grid.z_cell);
      EXPECT_LE(z, z_high + parts * grid.z_cell);
      ++compared;
    }
  }
  EXPECT_GT(compared, 2000u);
}

TEST(ProfileBoxes, TrianglesNotAcrossSectorsHaveAllCornersInOneTheSameOnEveryInstructionSet) {
  std::mt19937 random(9);
  std::size_t within = 0, across = 0;
  for (const double shift : {0.0, 3.0}) {
    const TriMesh mesh = test::triangles_of_all_sizes(random, shift, 1);
    const Listed best = listed(mesh, 20);
    std::set<Index> listed_across(best.boxes.across_sectors.begin(), best.boxes.across_sectors.end());
    ASSERT_EQ(listed_across.size(), best.boxes.across_sectors.size());
    for (Index t = 0; t < mesh.triangles.size(); ++t) {
      const auto& [a, b, c] = mesh.triangles[t];
      const auto& sector = best.vertices.sector;
      const bool in_one = (sector[a] & sector[b] & sector[c]) != 0;
      EXPECT_TRUE(in_one || listed_across.contains(t));
      within += !listed_across.contains(t), across += !in_one;
    }
    for (const simd::InstructionSet& set : simd::instruction_sets()) {
      const simd::InstructionSetInUse in_use(set);
      EXPECT_EQ(listed(mesh, 20).boxes.across_sectors, best.boxes.across_sectors) << set.name;
    }
  }
  EXPECT_GT(within, 200u);
  EXPECT_GT(across, 100u);
}

TEST(RingLists, ListsHoldTrianglesOnceAndAreFoundTheSameOnEveryInstructionSet) {
  std::mt19937 random(8);
  const TriMesh mesh = test::triangles_of_all_sizes(random, 2, 1);
  const Listed best = listed(mesh, 200);
  std::vector<CircleCell> circles;
  for (Index cell = 0; cell < best.lists.grid().cells(); ++cell) {
    const auto list = best.lists.of(cell);
    std::set<Index> triangles_listed;
    for (const RingEntry& entry : list) triangles_listed.insert(entry.triangle);
    EXPECT_EQ(triangles_listed.size(), list.size());
    for (CellBox at = 0; at < 16; ++at) {
      const CellBox z = 16 * at + 3, rho = 255 - 7 * at;
      circles.push_back({cell, z | (255 - z) << 8 | rho << 16 | (255 - rho) << 24});
    }
  }
  CandidatePairs expected;
  gather_candidates(best.lists, circles, 0, expected);
  EXPECT_GT(expected.circle.size(), 1000u);
  for (const simd::InstructionSet& set : simd::instruction_sets()) {
    const simd::InstructionSetInUse in_use(set);
    const Listed here = listed(mesh, 200);
    CandidatePairs pairs;
    gather_candidates(here.lists, circles, 0, pairs);
    const std::size_t both = std::min(pairs.circle.size(), expected.circle.size());
    EXPECT_GT(both, 1000u);
    for (std::size_t k = 0; k < both; ++k) {
      ASSERT_EQ(pairs.circle[k], expected.circle[k]) << set.name;
      ASSERT_EQ(pairs.triangle[k], expected.triangle[k]) << set.name;
    }
  }
}

}  // namespace
}  // namespace condyle::tangential
