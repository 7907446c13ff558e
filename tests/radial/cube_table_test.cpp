#include "radial/build/cube_table.hpp"

#include "radial/build/cell_radii.hpp"
#include "radial/build/direction_pyramid.hpp"
#include "radial/query/point_blocks.hpp"
#include "radial/update/slack_updates.hpp"
#include "simd/instruction_set.hpp"
#include "support/parameter_names.hpp"
#include "support/test.hpp"

namespace condyle::radial {
namespace {

/// Triangles of every size and place: small and large against a cell, over edges and corners of the cube,
/// seen edge-on, and slivers.
TriMesh triangle_soup(std::size_t count, double largest, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1, 1), exponent(-4, 0);
  TriMesh mesh;
  const auto point = [&](double scale) {
    return Vec3(scale * Vec3(uniform(random), uniform(random), uniform(random)));
  };
  for (std::size_t i = 0; i < count; ++i) {
    Vec3 a = point(1).normalized() * (2 + uniform(random));
    // Every third one near an edge or corner of the cube.
    if (i % 3 == 0) a = Vec3(1, i % 2 == 0 ? 1 : -1, i % 4 == 0 ? 1 : 0.3) * 1.5 + point(0.01);
    const double size = largest * std::pow(10, exponent(random));
    const Vec3 b = a + point(size);
    const Vec3 c = i % 5 == 0   ? Vec3(a + 0.3 * (b - a) + point(1e-9))
                   : i % 7 == 0 ? Vec3(1.5 * a)
                                : Vec3(a + point(size));
    for (const Vec3& corner : {a, b, c}) mesh.vertices.push_back(corner);
    const auto first = static_cast<Index>(3 * i);
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  return mesh;
}

Vec3 random_point(const TriMesh& mesh, Index t, std::mt19937& random) {
  std::uniform_real_distribution<double> unit(0, 1);
  double s = unit(random), r = unit(random);
  if (s + r > 1) s = 1 - s, r = 1 - r;
  if (random() % 4 == 0) s = 0;
  if (random() % 8 == 0) s = r = 0;
  return mesh.corner(t, 0) + s * (mesh.corner(t, 1) - mesh.corner(t, 0)) +
         r * (mesh.corner(t, 2) - mesh.corner(t, 0));
}

class CubeTableOn : public testing::TestWithParam<simd::InstructionSet> {
 protected:
  simd::InstructionSetInUse in_use_{GetParam()};
};

INSTANTIATE_TEST_SUITE_P(EveryInstructionSet, CubeTableOn, testing::ValuesIn(simd::instruction_sets()),
                         [](const auto& set) { return set.param.name; });

/// A table with its radii.
struct WithRadii {
  CubeTable table;
  CellRadii radii;

  WithRadii(const TriMesh& mesh, const CubeMap& map) {
    radial::build(mesh, map, table);
    radial::find_radii(map, table, radii);
  }
};

/// Points of every triangle, and directions next to theirs as near as floats may bring them, find it once in
/// their cell, in its 8-DOP and between the cell's radii.
void expect_points_find_their_triangles(const TriMesh& mesh, const CubeMap& map, const WithRadii& built,
                                        int points_per_triangle) {
  const CellEntries& entries = built.table.entries;
  const IntervalScale& scale = built.table.forms.scale;
  std::mt19937 random(1);
  for (Index t = 0; t < mesh.triangles.size(); ++t) {
    for (int k = 0; k < points_per_triangle; ++k) {
      const Vec3 p = random_point(mesh, t, random);
      const Vec3 v =
          k % 2 == 0 ? p : Vec3(p + 0x1p-17 * p.cwiseAbs().maxCoeff() * Vec3(1, -1, k % 4 == 0 ? 1 : -1) / 2);
      const Index cell = map.cell_of(v);
      const std::uint32_t place = map.place_of(v).axis;
      int found = 0, held = 0;
      for (std::uint32_t i = entries.row[cell].first; i < entries.row[cell].last; ++i) {
        if (entries.triangle[i] != t) continue;
        ++found;
        held += simd::holds(entries.axis[i], place) &&
                        simd::holds(entries.diagonal[i], radial::diagonal_of_point(place))
                    ? 1
                    : 0;
      }
      ASSERT_EQ(found, 1) << "triangle " << t << " cells " << map.cells_per_side();
      ASSERT_EQ(held, 1) << "triangle " << t << " cells " << map.cells_per_side();
      const auto squared = static_cast<float>(p.squaredNorm());
      ASSERT_LE(scale.least(static_cast<int>(built.radii.of_cell[cell] & 0xffff)), squared);
      ASSERT_GE(scale.greatest(0xffff - static_cast<int>(built.radii.of_cell[cell] >> 16)), squared);
    }
  }
}

TEST_P(CubeTableOn, EveryPointOfATriangleFindsItInItsCellDopAndRadii) {
  for (const double largest : {0.1, 1.0, 3.0}) {
    const TriMesh mesh = triangle_soup(400, largest, 2);
    for (const int cells : {1, 5, 16, 64}) {
      const CubeMap map(cells);
      expect_points_find_their_triangles(mesh, map, WithRadii(mesh, map), 20);
    }
  }
}

TEST_P(CubeTableOn, CellsThatClippingFindsHaveTheTriangle) {
  const TriMesh mesh = triangle_soup(400, 1, 7);
  for (const int cells : {5, 16, 64}) {
    const CubeMap map(cells);
    const WithRadii built(mesh, map);
    for (Index t = 0; t < mesh.triangles.size(); ++t) {
      map.visit_cells({mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2)},
                      [&](const CellOverlap& overlap) {
                        const auto of_cell = built.table.entries.of(overlap.cell);
                        EXPECT_EQ(std::count(of_cell.begin(), of_cell.end(), t), 1) << "triangle " << t;
                      });
    }
  }
}

/// Every vertex by up to `size` in each coordinate.
void jiggle(TriMesh& mesh, double size, std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(-size, size);
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
    mesh.vertices.set(i, mesh.vertices[i] + Vec3(uniform(random), uniform(random), uniform(random)));
}

TEST_P(CubeTableOn, EveryPointFindsItsTriangleAfterAllVerticesMoved) {
  std::mt19937 random(11);
  for (const int cells : {5, 16, 64}) {
    const CubeMap map(cells);
    TriMesh mesh = triangle_soup(300, 0.3, 8);
    WithRadii built(mesh, map);
    // Little, so that rows stay; now and then more than slack or a cell holds.
    for (const double size : {1e-3, 1e-3, 1e-2, 1e-4, 0.2, 1e-3}) {
      radial::init_slack(mesh, built.table);
      jiggle(mesh, size, random);
      radial::follow_rows(mesh, map, built.table);
      radial::place_corners(mesh, built.table.forms);
      radial::measure(mesh, built.table.forms);
      radial::find_radii(map, built.table, built.radii);
      expect_points_find_their_triangles(mesh, map, built, 10);
    }
  }
}

TEST_P(CubeTableOn, EveryPointFindsItsTriangleAfterSomeVerticesMoved) {
  std::mt19937 random(12);
  for (const int cells : {5, 16, 64}) {
    const CubeMap map(cells);
    TriMesh mesh = triangle_soup(300, 0.3, 9);
    WithRadii built(mesh, map);
    radial::init_slack(mesh, built.table);
    for (const double size : {1e-3, 1e-2, 1e-3, 0.2, 1e-4, 1e-2, 1e-3}) {
      TriMesh all = mesh;
      jiggle(all, size, random);
      // A soup: each vertex has one triangle.
      std::vector<Index> triangles, moved;
      for (Index t = 0; t < mesh.triangles.size(); ++t) {
        if (random() % 10 != 0) continue;
        triangles.push_back(t);
        for (const Index v : mesh.triangles[t]) {
          moved.push_back(v);
          mesh.vertices.set(v, all.vertices[v]);
        }
      }
      radial::init_slack(mesh, built.table);
      const std::vector<PackedInterval> before = built.radii.of_cell;
      ChangedRadii changed = radial::follow_vertices(mesh, map, moved, triangles, built.table, &built.radii);
      expect_points_find_their_triangles(mesh, map, built, 10);
      // Radii of the cells touched, and of the entries there, are those found anew for all.
      if (!changed.may_be_all) {
        std::vector<Index> others;
        for (Index cell = 0; cell < before.size(); ++cell)
          if (built.radii.of_cell[cell] != before[cell]) others.push_back(cell);
        std::sort(changed.cells.begin(), changed.cells.end());
        EXPECT_EQ(changed.cells, others);
      }
      CellRadii again = built.radii;
      radial::find_radii(map, built.table, again);
      EXPECT_EQ(again.of_cell, built.radii.of_cell);
      for (const CellRow& row : built.table.entries.row) {
        for (std::uint32_t i = row.first; i < row.last; ++i) {
          ASSERT_EQ(again.of_entry[i], built.radii.of_entry[i]);
          ASSERT_EQ(again.nearest[i], built.radii.nearest[i]);
        }
      }
    }
  }
}

TEST(CubeTable, TrianglesWhoseVerticesGoToAndFroAreBinnedOnce) {
  // Over edges of the cube too: a sphere about the centre.
  TriMesh mesh = test::sphere({0.1, 0, 0}, 20, 5);
  const CubeMap map(16);
  WithRadii built(mesh, map);
  std::mt19937 random(13);
  TriMesh there = mesh;
  jiggle(there, 0.1, random);
  for (int frame = 0; frame < 3; ++frame) {
    radial::init_slack(mesh, built.table);
    radial::follow_rows(frame % 2 == 0 ? there : mesh, map, built.table);
    radial::place_corners(frame % 2 == 0 ? there : mesh, built.table.forms);
    radial::measure(frame % 2 == 0 ? there : mesh, built.table.forms);
  }
  const auto& now = built.table.entries.triangle;
  const std::vector<Index> entries(now.begin(), now.end());
  for (int frame = 0; frame < 4; ++frame) {
    radial::follow_rows(frame % 2 == 0 ? mesh : there, map, built.table);
    radial::place_corners(frame % 2 == 0 ? mesh : there, built.table.forms);
    radial::measure(frame % 2 == 0 ? mesh : there, built.table.forms);
    EXPECT_TRUE(std::equal(entries.begin(), entries.end(), now.begin(), now.end()));
    radial::find_radii(map, built.table, built.radii);
    expect_points_find_their_triangles(frame % 2 == 0 ? mesh : there, map, built, 5);
  }
}

TEST_P(CubeTableOn, EdgeFunctionsThatAreNumbersSayOnWhichSideOfEdgesAndPlaneAPointIs) {
  const TriMesh mesh = triangle_soup(400, 1, 3);
  const WithRadii built(mesh, CubeMap(16));
  std::mt19937 random(4);
  std::size_t numbers = 0;
  for (Index t = 0; t < mesh.triangles.size(); ++t) {
    const EdgeFunctions& forms = built.table.forms.edge_functions[t];
    if (std::isnan(forms.x[0])) continue;
    ++numbers;
    const Vec3 a = mesh.corner(t, 0), b = mesh.corner(t, 1), c = mesh.corner(t, 2);
    const double volume = a.dot(b.cross(c));
    const Vec3 exact[4] = {a.cross(b) / volume, b.cross(c) / volume, c.cross(a) / volume,
                           (b - a).cross(c - a) / std::abs(volume)};
    for (int k = 0; k < 4; ++k) {
      // Half of coefficient_error's units and one rounding, of the sum of magnitudes; double adds 1e-9 of it
      // here.
      const double allowed = (radial::coefficient_error + 0x1p-24) * exact[k].cwiseAbs().sum() * (1 + 1e-6);
      EXPECT_NEAR(forms.x[k], exact[k].x(), allowed);
      EXPECT_NEAR(forms.y[k], exact[k].y(), allowed);
      EXPECT_NEAR(forms.z[k], exact[k].z(), allowed);
    }
  }
  EXPECT_GT(numbers, 200u);
}

TEST(IntervalScale, CodesRiseWithTheRadiusAndHoldIt) {
  const IntervalScale scale(3.0f, 5000.0f);
  int last = 0;
  for (float squared = 0.5f; squared < 2e4f; squared *= 1.0001f) {
    const int code = scale.code(squared);
    EXPECT_GE(code, last);
    EXPECT_LE(scale.least(code), squared);
    EXPECT_GE(scale.greatest(code), squared);
    EXPECT_TRUE(squared > 5000 || (code > 0) == (squared >= 3));
    EXPECT_TRUE(squared > 5000 || code < radial::greatest_radius_code);
    last = code;
  }
  EXPECT_EQ(scale.code(1e20f), radial::greatest_radius_code);
}

TEST(IntervalScale, AnEmptyIntervalAddsNothingAndMeetsNothing) {
  const PackedInterval word = radial::packed_interval(7, 9);
  EXPECT_EQ(simd::hull(word, radial::no_radii), word);
  EXPECT_EQ(simd::hull(radial::packed_interval(3, 5), radial::packed_interval(4, 8)),
            radial::packed_interval(3, 8));
}

/// Place on the face of a cube map, in [-1, 1].
struct Place {
  int face;
  double u, w;
};
Place place_of(const Vec3& v) {
  int axis = 0;
  const double largest = v.cwiseAbs().maxCoeff(&axis);
  return {axis + (v[axis] < 0 ? 3 : 0), v[(axis + 1) % 3] / largest, v[(axis + 2) % 3] / largest};
}

TEST_P(CubeTableOn, AnEntryOfThePyramidHoldsAllDirectionsDisplacedByNoMoreThanItsDilation) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (const int cells : {1, 3, 4, 12, 24, 32}) {
    const CubeMap map(cells);
    std::vector<PackedInterval> radii(map.cell_count());
    for (auto& word : radii)
      word =
          radial::packed_interval(static_cast<int>(random() % 100), static_cast<int>(100 + random() % 100));
    DirectionPyramid pyramid;
    pyramid.fill(cells, radii);
    for (int k = 0; k < 100000; ++k) {
      const int level =
          static_cast<int>(random() % static_cast<unsigned>(DirectionPyramid::level_count(cells)));
      const int n = cells >> DirectionPyramid::halvings_of(level);
      const Place at = place_of({uniform(random), uniform(random), uniform(random)});
      const auto index = [&](double s) { return std::clamp(static_cast<int>((s + 1) * n / 2), 0, n - 1); };
      const std::size_t start = DirectionPyramid::start_of(level, cells);
      const PackedInterval entry =
          pyramid.data()[start + static_cast<std::size_t>((at.face * n + index(at.w)) * n + index(at.u))];
      // A direction displaced on the plane of the face, past its edges too.
      const double width = DirectionPyramid::dilation_of(level) * 2.0 / n;
      Vec3 displaced;
      displaced[at.face % 3] = at.face < 3 ? 1 : -1;
      displaced[(at.face + 1) % 3] = at.u + width * uniform(random);
      displaced[(at.face + 2) % 3] = at.w + width * uniform(random);
      const PackedInterval word = radii[map.cell_of(displaced)];
      ASSERT_EQ(simd::hull(entry, word), entry);
    }
  }
}

/// A tile of the cube: its face, and the middle of it.
struct Tile {
  int face;
  Vec3 middle;
};

std::vector<Tile> tiles_of(int n) {
  std::vector<Tile> tiles;
  for (int face = 0; face < 6; ++face) {
    for (int row = 0; row < n; ++row) {
      for (int column = 0; column < n; ++column) {
        Vec3 middle;
        middle[face % 3] = face < 3 ? 1 : -1;
        middle[(face + 1) % 3] = (2.0 * column + 1) / n - 1, middle[(face + 2) % 3] = (2.0 * row + 1) / n - 1;
        tiles.push_back({face, middle});
      }
    }
  }
  return tiles;
}

/// Whether a tile's entry with that dilation takes in another tile: within the dilation on its face; beyond an
/// edge, as far as the dilation reaches, and along it by the dilation and what lies beyond the edge.
bool reaches(const Tile& from, const Tile& to, int n, int dilation) {
  const auto apart = [&](int axis) {
    return static_cast<int>(std::lround(std::abs(from.middle[axis] - to.middle[axis]) * n / 2));
  };
  const int own = from.face % 3, other = to.face % 3;
  if (from.face == to.face) return std::max(apart((own + 1) % 3), apart((own + 2) % 3)) <= dilation;
  if (own == other) return false;
  // From one's middle to the edge between them, in tiles, and on to the other's: both count from the edge.
  const auto from_edge = [&](const Vec3& middle, int axis, int face) {
    return static_cast<int>(std::floor((1 - (face < 3 ? 1 : -1) * middle[axis]) * n / 2));
  };
  const int before = from_edge(from.middle, other, to.face), beyond = from_edge(to.middle, own, from.face);
  return before + beyond < dilation && apart(3 - own - other) <= dilation + beyond + 1;
}

TEST_P(CubeTableOn, AnEntryOfThePyramidIsTheHullOfTheTilesThatItsDilationReaches) {
  std::mt19937 random(8);
  for (const int cells : {1, 2, 3, 5, 8, 12, 20}) {
    std::vector<PackedInterval> radii(6 * static_cast<std::size_t>(cells * cells));
    for (auto& word : radii)
      word = radial::packed_interval(static_cast<int>(random() % 1000),
                                     static_cast<int>(1000 + random() % 1000));
    DirectionPyramid pyramid;
    pyramid.fill(cells, radii);
    for (const int level : {0, 1, 2}) {
      const std::vector<Tile> tiles = tiles_of(cells);
      for (std::size_t i = 0; i < tiles.size(); ++i) {
        PackedInterval all = radial::no_radii;
        for (std::size_t k = 0; k < tiles.size(); ++k) {
          if (reaches(tiles[i], tiles[k], cells, DirectionPyramid::dilation_of(level)))
            all = simd::hull(all, radii[k]);
        }
        ASSERT_EQ(pyramid.data()[DirectionPyramid::start_of(level, cells) + i], all) << cells << " " << level;
      }
    }
  }
}

TEST_P(CubeTableOn, APyramidOfWhichSomeCellsHaveChangedIsThatOfAllCells) {
  std::mt19937 random(9);
  const auto any_radii = [&] {
    return radial::packed_interval(static_cast<int>(random() % 1000),
                                   static_cast<int>(1000 + random() % 1000));
  };
  for (const int cells : {1, 3, 5, 8, 16, 24, 40}) {
    std::vector<PackedInterval> radii(6 * static_cast<std::size_t>(cells * cells));
    for (auto& word : radii) word = any_radii();
    DirectionPyramid followed;
    followed.fill(cells, radii);
    for (int round = 0; round < 40; ++round) {
      std::vector<Index> changed(1 + random() % 3);
      for (Index& cell : changed) {
        cell = static_cast<Index>(random() % radii.size());
        radii[cell] = any_radii();
      }
      followed.refill(cells, radii, changed);
      DirectionPyramid anew;
      anew.fill(cells, radii);
      const std::span followed_all(followed.data(), followed.size()), all(anew.data(), anew.size());
      ASSERT_TRUE(std::equal(followed_all.begin(), followed_all.end(), all.begin(), all.end())) << cells;
    }
  }
}

TEST(PointBlocks, BlocksHoldEachPointOnceWithinTheirCapsAndRadii) {
  std::mt19937 random(6);
  std::uniform_real_distribution<double> uniform(-1, 1);
  Points points;
  for (int i = 0; i < 3001; ++i)
    points.push_back({uniform(random), uniform(random) * uniform(random), uniform(random)});
  const Vec3 centre(0.2, -0.1, 0.3);
  const PointBlocks sorted(points, centre);
  std::vector<Index> numbers(sorted.index().begin(), sorted.index().end());
  std::sort(numbers.begin(), numbers.end());
  for (Index i = 0; i < points.size(); ++i) ASSERT_EQ(numbers[i], i);
  using S = PointBlocks;
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    ASSERT_EQ(sorted[i], points[sorted.index()[i]]);
    const Vec3 p = sorted[i] - centre;
    for (std::size_t level = 0; level < S::levels; ++level) {
      const std::size_t block = i / (level == 0 ? S::fan : S::fan * S::fan);
      const auto value = [&](S::Column column) {
        return static_cast<double>(sorted.block(level, column)[block]);
      };
      const Vec3 axis(value(S::axis_x), value(S::axis_y), value(S::axis_z));
      EXPECT_LE((p / p.norm() - axis).norm(), value(S::chord));
      EXPECT_LE(value(S::nearest), p.norm());
      EXPECT_GE(value(S::furthest), p.norm());
      EXPECT_LE(std::abs(1 / p.norm() - value(S::mean_inverse)), value(S::spread));
    }
  }
}

}  // namespace
}  // namespace condyle::radial
