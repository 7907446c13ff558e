#include "condyle/tangential.hpp"

#include "mesh/winding_number.hpp"
#include "support/test.hpp"
#include "tangential/about_z.hpp"
#include "tangential/circle_oracle.hpp"
#include "tangential/exact/circle_crossing.hpp"

namespace condyle::tangential {
namespace {

using test::infinity, test::z_axis;

/// Against the obvious version: every piece of every circle, and every end of an arc at a place where the
/// surface is.
void expect_same_as_oracle(const TriMesh& mesh, const Points& points) {
  const RingTable table(mesh, z_axis);
  const auto arcs = table.occupied_arcs(points);
  const auto results = table.query(points);
  const auto windings = mesh::WindingNumber(mesh).at(points);
  std::size_t compared = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec3 p = points[i];
    EXPECT_EQ(results.state[i], windings[i].state) << p.transpose();
    if (windings[i].state != PointState::on_surface) {
      EXPECT_EQ(results.winding[i], windings[i].winding);
    }
    if (p.x() == 0 && p.y() == 0) continue;
    const auto pieces = test::circle_pieces(mesh, p);
    for (const auto& piece : pieces) {
      if (piece.end - piece.begin < 1e-3) continue;
      ++compared;
      const double middle = (piece.begin + piece.end) / 2;
      EXPECT_EQ(arcs.inside_at(i, Angle::radians(middle)), piece.winding > 0)
          << "point " << p.transpose() << " rotated by " << middle;
    }
    for (const auto& arc : arcs.of(i)) {
      for (const double end : {arc.begin.radians(), arc.end.radians()}) {
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
  EXPECT_GT(compared, points.size() / 2);
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
        tangential::add_crossings(circle, corners, t, all, work);
        outwards += tangential::outward_crossing(circle, corners, work);
      }
      for (const auto& crossing : all) sum += static_cast<int>(crossing.passage);
      EXPECT_EQ(sum, 0);
      // The ray outwards is a second, independent way to the winding number.
      const auto winding = mesh::WindingNumber(mesh).at(p);
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
    // one point only has an arc of no length there, and rounding decides whether it appears.
    for (std::size_t v = 0; v < finer.vertices.size(); v += 3) {
      const Vec3 p = finer.vertices[v];
      points.push_back({p.x(), 1, p.z()});
      points.push_back({0.3, p.y(), p.z()});
    }
    const auto before = RingTable(mesh, z_axis).query(points), after = RingTable(finer, z_axis).query(points);
    EXPECT_EQ(before.state, after.state);
    EXPECT_EQ(before.winding, after.winding);
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (std::isinf(before.angular_gap[i].radians())) {
        EXPECT_EQ(before.angular_gap[i].radians(), after.angular_gap[i].radians());
        continue;
      }
      // Each errs by at most sqrt(2 e / rho), were it a touch: e = 17u * 4 mm * sqrt 2.
      const double rho = tangential::axis_radius(points[i].x(), points[i].y());
      EXPECT_NEAR(before.angular_gap[i].radians(), after.angular_gap[i].radians(),
                  2 * std::sqrt(2 * 17 * 6 * core::rounding_unit / rho));
      ++finite;
    }
  }
  EXPECT_GT(finite, 1000u);
}

}  // namespace
}  // namespace condyle::tangential
