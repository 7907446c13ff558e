#include "radial/exact/direction_map.hpp"

#include "radial/exact/cell_dop.hpp"
#include "support/test.hpp"

namespace condyle::radial {
namespace {

/// On the paper's map with the radii of the whole triangle: it says none.
std::map<Index, CellOverlap> cells_of(const CartesianMap& map, const Cone& cone) {
  std::map<Index, CellOverlap> cells;
  const auto box = map.box_of(cone.a.normalized(), cone.b.normalized(), cone.c.normalized());
  map.visit_cells(box, [&](Index cell) {
    EXPECT_TRUE(cells.emplace(cell, CellOverlap{cell, 0, HUGE_VAL}).second)
        << "cell " << cell << " visited twice";
  });
  return cells;
}

std::map<Index, CellOverlap> cells_of(const CubeMap& map, const Cone& cone) {
  std::map<Index, CellOverlap> cells;
  map.visit_cells(cone, [&](const CellOverlap& overlap) {
    EXPECT_TRUE(cells.emplace(overlap.cell, overlap).second) << "cell " << overlap.cell << " visited twice";
  });
  return cells;
}

Cone random_cone(std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::uniform_real_distribution<double> exponent(-3, 0.5);
  const auto point = [&](double scale) {
    return Vec3(scale * Vec3(uniform(random), uniform(random), uniform(random)));
  };
  const Vec3 a = point(1);
  const double size = std::pow(10, exponent(random));
  return {a, a + point(size), a + point(size)};
}

template <class Map>
class DirectionMap : public testing::Test {};
using Maps = testing::Types<CartesianMap, CubeMap>;
TYPED_TEST_SUITE(DirectionMap, Maps);

TYPED_TEST(DirectionMap, EveryPointOfATriangleFallsIntoAListedCellAndItsRadiusInterval) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(0, 1);
  for (const int cells_per_side : {1, 7, 32}) {
    const TypeParam map(cells_per_side);
    for (int i = 0; i < 300; ++i) {
      const Cone cone = random_cone(random);
      const auto cells = cells_of(map, cone);
      for (int k = 0; k < 300; ++k) {
        double s = unit(random), t = unit(random);
        if (s + t > 1) s = 1 - s, t = 1 - t;
        if (k % 3 == 0) s = 0;      // along an edge
        if (k % 7 == 0) s = t = 0;  // at a corner
        const Vec3 p = cone.a + s * (cone.b - cone.a) + t * (cone.c - cone.a);
        const auto at = cells.find(map.cell_of(p));
        ASSERT_NE(at, cells.end());
        EXPECT_LE(at->second.min_radius, p.norm());
        EXPECT_GE(at->second.max_radius, p.norm());
      }
    }
  }
}

TYPED_TEST(DirectionMap, TrianglesThroughTheAxesAndTheDiagonalsAreListedWhereTheirCornersAre) {
  const TypeParam map(8);
  int compared = 0;
  for (const Vec3& a : {Vec3(1, 0, 0), Vec3(0, 0, -1), Vec3(1, 1, 1), Vec3(-1, 1, -1), Vec3(1, 1, 0)}) {
    for (const Vec3& b : {Vec3(0, 1, 0), Vec3(0, -1, 0), Vec3(-1, -1, 1)}) {
      const Cone cone{2 * a, b, Vec3(0.5, 0.25, 3)};
      const auto cells = cells_of(map, cone);
      for (const Vec3& p : {cone.a, cone.b, cone.c, Vec3(0.5 * (cone.a + cone.b))}) {
        if (p.norm() == 0) continue;
        EXPECT_TRUE(cells.contains(map.cell_of(p)));
        ++compared;
      }
    }
  }
  EXPECT_GE(compared, 5 * 3 * 4 - 2);
}

TYPED_TEST(DirectionMap, ATriangleSeenEdgeOnIsStillListedAlongItsLine) {
  // The plane z = 0 holds the origin: the cone has no width, but pairs and points on the surface still need
  // it.
  const TypeParam map(16);
  const Cone cone{{3, 1, 0}, {3, 2, 0}, {4, 1.5, 0}};
  const auto cells = cells_of(map, cone);
  for (double s = 0; s <= 1; s += 0.01) {
    const Vec3 p = cone.a + s * (cone.b - cone.a);
    EXPECT_TRUE(cells.contains(map.cell_of(p)));
  }
  EXPECT_LT(cells.size(), map.cell_count() / 4u);
}

TYPED_TEST(DirectionMap, ATriangleAlmostThroughTheOriginIsListedEverywhere) {
  const TypeParam map(4);
  EXPECT_EQ(cells_of(map, {{1, 0, 1e-9}, {-1, 1, 1e-9}, {-1, -1, 1e-9}}).size(), map.cell_count());
}

TYPED_TEST(DirectionMap, SliversKeepTheirRadiusInterval) {
  const TypeParam map(8);
  std::mt19937 random(6);
  std::uniform_real_distribution<double> unit(0, 1);
  for (const double width : {1e-6, 1e-10, 1e-14, 0.0}) {
    const Cone cone{{10, -5, 3}, {10, 5, 3}, {10 + width, 0.3, 3 - width}};
    const auto cells = cells_of(map, cone);
    for (int k = 0; k < 1000; ++k) {
      const double s = unit(random), t = (1 - s) * unit(random);
      const Vec3 p = cone.a + s * (cone.b - cone.a) + t * (cone.c - cone.a);
      const auto at = cells.find(map.cell_of(p));
      ASSERT_NE(at, cells.end());
      EXPECT_LE(at->second.min_radius, p.norm());
      EXPECT_GE(at->second.max_radius, p.norm());
    }
  }
}

TYPED_TEST(DirectionMap, TheCellOfADirectionDoesNotDependOnItsLength) {
  const TypeParam map(16);
  const Vec3 v(0.3, -0.7, 0.2);
  for (const double length : {1e-300, 1e-170, 1e-100, 1e100, 1e160, 1e300}) {
    EXPECT_EQ(map.cell_of(length * v), map.cell_of(v));
  }
}

TEST(CubeMap, RadiusIntervalsAreThoseInsideTheCellNotOfTheWholeTriangle) {
  // A long triangle in the plane x = 10 reaches far out; the cell straight ahead sees it at radius 10 only.
  const CubeMap map(64);
  const auto cells = cells_of(map, {{10, -9, -9}, {10, 9, -9}, {10, 0, 9}});
  const auto& ahead = cells.at(map.cell_of({10, 0.1, 0.1}));
  EXPECT_NEAR(ahead.min_radius, 10, 1e-6);
  // The cell spans 2/64 of the face, widened: its far corner lies at 10 sqrt(1 + 2 (2/64 + margin)^2).
  const double corner = 2.0 / 64 + radial::list_margin;
  EXPECT_LE(ahead.max_radius, 10 * std::sqrt(1 + 2 * corner * corner) * (1 + 1e-7));
}

TEST(CubeMap, ListsAreNotLongerThanTheExactOverlap) {
  // A triangle over exactly the lower left quarter of face +x, strictly inside the cells' borders.
  const CubeMap map(8);
  const auto cells = cells_of(map, {{1, -0.99, -0.99}, {1, -0.02, -0.99}, {1, -0.99, -0.02}});
  // Cells 0..3 in each direction; those strictly above the diagonal i + j = 3 are not met.
  EXPECT_EQ(cells.size(), 10u);
}

}  // namespace
}  // namespace condyle::radial
