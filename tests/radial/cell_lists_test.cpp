#include "radial/build/cell_lists.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "radial/build/direction_pyramid.hpp"
#include "radial/query/point_blocks.hpp"
#include "simd/instruction_set.hpp"
#include "support/test_meshes.hpp"

namespace condyle {
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

class CubeListsOn : public testing::TestWithParam<simd::InstructionSet> {
 protected:
  simd::InstructionSetInUse in_use_{GetParam()};
};

INSTANTIATE_TEST_SUITE_P(EveryInstructionSet, CubeListsOn, testing::ValuesIn(simd::instruction_sets()),
                         [](const auto& set) { return set.param.name; });

/// Points of every triangle, and directions next to theirs as near as floats may bring them, find it once in
/// their cell, in its octagon and between the cell's radii.
void expect_points_find_their_triangles(const TriMesh& mesh, const radial::CubeMap& map,
                                        const radial::CellLists& lists, int points_per_triangle) {
  std::mt19937 random(1);
  for (Index t = 0; t < mesh.triangles.size(); ++t) {
    for (int k = 0; k < points_per_triangle; ++k) {
      const Vec3 p = random_point(mesh, t, random);
      const Vec3 v =
          k % 2 == 0 ? p : Vec3(p + 0x1p-17 * p.cwiseAbs().maxCoeff() * Vec3(1, -1, k % 4 == 0 ? 1 : -1) / 2);
      const Index cell = map.cell_of(v);
      const std::uint32_t place = map.box_of(v);
      int found = 0, held = 0;
      for (std::uint32_t i = lists.row[cell].first; i < lists.row[cell].last; ++i) {
        if (lists.triangle[i] != t) continue;
        ++found;
        held +=
            radial::holds(lists.box[i], place) && radial::holds(lists.slant[i], radial::slant_of_point(place))
                ? 1
                : 0;
      }
      ASSERT_EQ(found, 1) << "triangle " << t << " cells " << map.cells_per_side();
      ASSERT_EQ(held, 1) << "triangle " << t << " cells " << map.cells_per_side();
      const auto squared = static_cast<float>(p.squaredNorm());
      ASSERT_LE(lists.scale.least(static_cast<int>(lists.radii[cell] & 0xffff)), squared);
      ASSERT_GE(lists.scale.greatest(0xffff - static_cast<int>(lists.radii[cell] >> 16)), squared);
    }
  }
}

TEST_P(CubeListsOn, EveryPointOfATriangleFindsItInItsCellOctagonAndRadii) {
  for (const double largest : {0.1, 1.0, 3.0}) {
    const TriMesh mesh = triangle_soup(400, largest, 2);
    for (const int cells : {1, 5, 16, 64}) {
      const radial::CubeMap map(cells);
      expect_points_find_their_triangles(mesh, map, radial::list_cells(mesh, map), 20);
    }
  }
}

TEST_P(CubeListsOn, CellsThatClippingFindsAreListed) {
  const TriMesh mesh = triangle_soup(400, 1, 7);
  for (const int cells : {5, 16, 64}) {
    const radial::CubeMap map(cells);
    const radial::CellLists lists = radial::list_cells(mesh, map);
    for (Index t = 0; t < mesh.triangles.size(); ++t) {
      map.visit_cells({mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2)},
                      [&](const radial::CellOverlap& overlap) {
                        const auto listed = lists.of(overlap.cell);
                        EXPECT_EQ(std::count(listed.begin(), listed.end(), t), 1) << "triangle " << t;
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

TEST_P(CubeListsOn, EveryPointFindsItsTriangleAfterAllVerticesMoved) {
  std::mt19937 random(11);
  for (const int cells : {5, 16, 64}) {
    const radial::CubeMap map(cells);
    TriMesh mesh = triangle_soup(300, 0.3, 8);
    radial::CellLists lists = radial::list_cells(mesh, map);
    // Little, so that lists stay; now and then more than a room or a cell holds.
    for (const double size : {1e-3, 1e-3, 1e-2, 1e-4, 0.2, 1e-3}) {
      radial::make_rooms(mesh, lists);
      jiggle(mesh, size, random);
      radial::follow_vertices(mesh, map, lists);
      radial::find_radii(map, lists);
      expect_points_find_their_triangles(mesh, map, lists, 10);
    }
  }
}

TEST_P(CubeListsOn, EveryPointFindsItsTriangleAfterSomeVerticesMoved) {
  std::mt19937 random(12);
  for (const int cells : {5, 16, 64}) {
    const radial::CubeMap map(cells);
    TriMesh mesh = triangle_soup(300, 0.3, 9);
    radial::CellLists lists = radial::list_cells(mesh, map);
    radial::make_rooms(mesh, lists);
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
      radial::make_rooms(mesh, lists);
      const std::vector<radial::RadiusWord> before = lists.radii;
      radial::ChangedRadii changed = radial::follow_vertices(mesh, map, moved, triangles, lists);
      expect_points_find_their_triangles(mesh, map, lists, 10);
      // Radii of the cells touched, and of what is listed there, are those found anew for all.
      if (!changed.may_be_all) {
        std::vector<Index> others;
        for (Index cell = 0; cell < lists.radii.size(); ++cell)
          if (lists.radii[cell] != before[cell]) others.push_back(cell);
        std::sort(changed.cells.begin(), changed.cells.end());
        EXPECT_EQ(changed.cells, others);
      }
      radial::CellLists again = lists;
      radial::find_radii(map, again);
      EXPECT_EQ(again.radii, lists.radii);
      for (const radial::CellRow& row : lists.row) {
        for (std::uint32_t i = row.first; i < row.last; ++i) {
          ASSERT_EQ(again.entry_radii[i], lists.entry_radii[i]);
          ASSERT_EQ(again.nearest[i], lists.nearest[i]);
        }
      }
    }
  }
}

TEST(CubeLists, VerticesThatGoToAndFroAreListedOnce) {
  // Over edges of the cube too: a sphere about the centre.
  TriMesh mesh = test::sphere({0.1, 0, 0}, 20, 5);
  const radial::CubeMap map(16);
  radial::CellLists lists = radial::list_cells(mesh, map);
  std::mt19937 random(13);
  TriMesh there = mesh;
  jiggle(there, 0.1, random);
  for (int frame = 0; frame < 3; ++frame) {
    radial::make_rooms(mesh, lists);
    radial::follow_vertices(frame % 2 == 0 ? there : mesh, map, lists);
  }
  const std::vector<Index> entries(lists.triangle.begin(), lists.triangle.end());
  for (int frame = 0; frame < 4; ++frame) {
    radial::follow_vertices(frame % 2 == 0 ? mesh : there, map, lists);
    EXPECT_TRUE(std::equal(entries.begin(), entries.end(), lists.triangle.begin(), lists.triangle.end()));
    radial::find_radii(map, lists);
    expect_points_find_their_triangles(frame % 2 == 0 ? mesh : there, map, lists, 5);
  }
}

TEST_P(CubeListsOn, FormsThatAreNumbersTellOnWhichSideOfEdgesAndPlaneAPointIs) {
  const TriMesh mesh = triangle_soup(400, 1, 3);
  const radial::CellLists lists = radial::list_cells(mesh, radial::CubeMap(16));
  std::mt19937 random(4);
  std::size_t numbers = 0;
  for (Index t = 0; t < mesh.triangles.size(); ++t) {
    const radial::ConeForms& forms = lists.forms[t];
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

TEST(RadiusScale, CodesRiseWithTheRadiusAndHoldIt) {
  const radial::RadiusScale scale(3.0f, 5000.0f);
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

TEST(RadiusScale, AnEmptyIntervalAddsNothingAndMeetsNothing) {
  const radial::RadiusWord word = radial::radius_word(7, 9);
  EXPECT_EQ(radial::union_of(word, radial::no_radii), word);
  EXPECT_EQ(radial::union_of(radial::radius_word(3, 5), radial::radius_word(4, 8)),
            radial::radius_word(3, 8));
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

TEST_P(CubeListsOn, AnEntryOfThePyramidHoldsAllDirectionsDisplacedByNoMoreThanItsBorder) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (const int cells : {1, 3, 4, 12, 24, 32}) {
    const radial::CubeMap map(cells);
    std::vector<radial::RadiusWord> radii(map.cell_count());
    for (auto& word : radii)
      word = radial::radius_word(static_cast<int>(random() % 100), static_cast<int>(100 + random() % 100));
    radial::DirectionPyramid pyramid;
    pyramid.fill(cells, radii);
    for (int k = 0; k < 100000; ++k) {
      const int step =
          static_cast<int>(random() % static_cast<unsigned>(radial::DirectionPyramid::step_count(cells)));
      const int n = cells >> radial::DirectionPyramid::level_of(step);
      const Place at = place_of({uniform(random), uniform(random), uniform(random)});
      const auto index = [&](double s) { return std::clamp(static_cast<int>((s + 1) * n / 2), 0, n - 1); };
      const std::size_t start = radial::DirectionPyramid::start_of(step, cells);
      const radial::RadiusWord entry =
          pyramid.data()[start + static_cast<std::size_t>((at.face * n + index(at.w)) * n + index(at.u))];
      // A direction displaced on the plane of the face, past its edges too.
      const double width = radial::DirectionPyramid::border_of(step) * 2.0 / n;
      Vec3 displaced;
      displaced[at.face % 3] = at.face < 3 ? 1 : -1;
      displaced[(at.face + 1) % 3] = at.u + width * uniform(random);
      displaced[(at.face + 2) % 3] = at.w + width * uniform(random);
      const radial::RadiusWord word = radii[map.cell_of(displaced)];
      ASSERT_EQ(radial::union_of(entry, word), entry);
    }
  }
}

/// A piece of the cube: its face, and the middle of it.
struct Piece {
  int face;
  Vec3 middle;
};

std::vector<Piece> pieces_of(int n) {
  std::vector<Piece> pieces;
  for (int face = 0; face < 6; ++face) {
    for (int row = 0; row < n; ++row) {
      for (int column = 0; column < n; ++column) {
        Vec3 middle;
        middle[face % 3] = face < 3 ? 1 : -1;
        middle[(face + 1) % 3] = (2.0 * column + 1) / n - 1, middle[(face + 2) % 3] = (2.0 * row + 1) / n - 1;
        pieces.push_back({face, middle});
      }
    }
  }
  return pieces;
}

/// Whether a piece's entry with that border takes in another piece: within the border on its face; beyond an
/// edge, as far as the border reaches, and along it by the border and what lies beyond the edge.
bool reaches(const Piece& from, const Piece& to, int n, int border) {
  const auto apart = [&](int axis) {
    return static_cast<int>(std::lround(std::abs(from.middle[axis] - to.middle[axis]) * n / 2));
  };
  const int own = from.face % 3, other = to.face % 3;
  if (from.face == to.face) return std::max(apart((own + 1) % 3), apart((own + 2) % 3)) <= border;
  if (own == other) return false;
  // From one's middle to the edge between them, in pieces, and on to the other's: both count from the edge.
  const auto from_edge = [&](const Vec3& middle, int axis, int face) {
    return static_cast<int>(std::floor((1 - (face < 3 ? 1 : -1) * middle[axis]) * n / 2));
  };
  const int before = from_edge(from.middle, other, to.face), beyond = from_edge(to.middle, own, from.face);
  return before + beyond < border && apart(3 - own - other) <= border + beyond + 1;
}

TEST_P(CubeListsOn, AnEntryOfThePyramidIsTheUnionOfThePiecesThatItsBorderReaches) {
  std::mt19937 random(8);
  for (const int cells : {1, 2, 3, 5, 8, 12, 20}) {
    std::vector<radial::RadiusWord> radii(6 * static_cast<std::size_t>(cells * cells));
    for (auto& word : radii)
      word = radial::radius_word(static_cast<int>(random() % 1000), static_cast<int>(1000 + random() % 1000));
    radial::DirectionPyramid pyramid;
    pyramid.fill(cells, radii);
    for (const int step : {0, 1, 2}) {
      const std::vector<Piece> pieces = pieces_of(cells);
      for (std::size_t i = 0; i < pieces.size(); ++i) {
        radial::RadiusWord all = radial::no_radii;
        for (std::size_t k = 0; k < pieces.size(); ++k) {
          if (reaches(pieces[i], pieces[k], cells, radial::DirectionPyramid::border_of(step)))
            all = radial::union_of(all, radii[k]);
        }
        ASSERT_EQ(pyramid.data()[radial::DirectionPyramid::start_of(step, cells) + i], all)
            << cells << " " << step;
      }
    }
  }
}

TEST_P(CubeListsOn, APyramidOfWhichSomeCellsHaveChangedIsThatOfAllCells) {
  std::mt19937 random(9);
  const auto any_radii = [&] {
    return radial::radius_word(static_cast<int>(random() % 1000), static_cast<int>(1000 + random() % 1000));
  };
  for (const int cells : {1, 3, 5, 8, 16, 24, 40}) {
    std::vector<radial::RadiusWord> radii(6 * static_cast<std::size_t>(cells * cells));
    for (auto& word : radii) word = any_radii();
    radial::DirectionPyramid followed;
    followed.fill(cells, radii);
    for (int round = 0; round < 40; ++round) {
      std::vector<Index> changed(1 + random() % 3);
      for (Index& cell : changed) {
        cell = static_cast<Index>(random() % radii.size());
        radii[cell] = any_radii();
      }
      followed.refill(cells, radii, changed);
      radial::DirectionPyramid anew;
      anew.fill(cells, radii);
      const std::span followed_all(followed.data(), followed.size()), all(anew.data(), anew.size());
      ASSERT_TRUE(std::equal(followed_all.begin(), followed_all.end(), all.begin(), all.end())) << cells;
      ASSERT_EQ(followed.all(), anew.all());
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
  const radial::PointBlocks sorted(points, centre);
  std::vector<Index> numbers(sorted.index().begin(), sorted.index().end());
  std::sort(numbers.begin(), numbers.end());
  for (Index i = 0; i < points.size(); ++i) ASSERT_EQ(numbers[i], i);
  using S = radial::PointBlocks;
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
}  // namespace condyle
