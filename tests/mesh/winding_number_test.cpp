#include "mesh/winding_number.hpp"

#include "core/thread_limit.hpp"
#include "support/brute_force.hpp"
#include "support/test.hpp"

namespace condyle {
namespace {

/// Every point against rational arithmetic on another ray; returns how many lie on the surface.
int expect_same_as_brute_force(const TriMesh& mesh, const Points& points) {
  const mesh::WindingNumber fast(mesh);
  int on_surface = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const mesh::PointWinding got = fast.at(points[i]);
    const auto expected = test::winding_number(mesh, points[i]);
    EXPECT_EQ(got.state == PointState::on_surface, expected.on_surface) << points[i].transpose();
    EXPECT_EQ(got.winding, expected.winding) << points[i].transpose();
    if (!expected.on_surface) {
      EXPECT_EQ(got.state == PointState::inside, expected.winding > 0);
    }
    EXPECT_EQ(got.triangle == no_index, !expected.on_surface);
    on_surface += expected.on_surface;
  }
  return on_surface;
}

/// A lattice of (2n + 1)^3 points with the given spacing about the origin.
Points lattice(int n, double spacing) {
  Points points;
  for (int x = -n; x <= n; ++x) {
    for (int y = -n; y <= n; ++y) {
      for (int z = -n; z <= n; ++z) points.push_back({x * spacing, y * spacing, z * spacing});
    }
  }
  return points;
}

TEST(WindingNumber, OfABoxAtItsVerticesEdgesFacesAndBesideThem) {
  // The lattice holds the corners, edge middles, diagonals of the faces, points above every one of them, and
  // beyond.
  EXPECT_EQ(expect_same_as_brute_force(test::box({-1, -1, -1}, {1, 1, 1}), lattice(3, 0.5)), 125 - 27);
}

TEST(WindingNumber, OneUnitInTheLastPlaceDecides) {
  const mesh::WindingNumber box(test::box({-1, -1, -1}, {1, 1, 1}));
  for (int axis = 0; axis < 3; ++axis) {
    for (const double sense : {-1.0, 1.0}) {
      Vec3 p(0.25, 0.25, 0.25);
      p[axis] = sense;
      EXPECT_EQ(box.at(p).state, PointState::on_surface);
      p[axis] = std::nextafter(sense, 0);
      EXPECT_EQ(box.at(p).state, PointState::inside);
      p[axis] = std::nextafter(sense, 2 * sense);
      EXPECT_EQ(box.at(p).state, PointState::outside);
    }
  }
}

TEST(WindingNumber, RaysThroughVerticesAndEdgesOfASphereAreDecidedOnce) {
  // Its vertices lie on the axes and on planes of symmetry: rays from the lattice meet many of them exactly.
  EXPECT_GT(expect_same_as_brute_force(test::sphere(Vec3::Zero(), 1, 2), lattice(2, 0.5)), 5);
}

TEST(WindingNumber, NestedAndOverlappingComponentsAdd) {
  const TriMesh outer = test::box({-1, -1, -1}, {1, 1, 1}),
                inner = test::box({-0.5, -0.5, -0.5}, {1.5, 0.5, 0.5});
  const TriMesh both = test::joined(outer, inner);
  const mesh::WindingNumber winding(both);
  EXPECT_EQ(winding.at({0.1, 0.2, 0.3}).winding, 2);
  EXPECT_EQ(winding.at({-0.7, 0.2, 0.3}).winding, 1);
  EXPECT_EQ(winding.at({1.2, 0.2, 0.3}).winding, 1);
  EXPECT_EQ(winding.at({1.2, 0.7, 0.3}).winding, 0);
  EXPECT_GT(expect_same_as_brute_force(both, lattice(4, 0.5)), 50);
  // A cavity: the inner boundary wound the other way.
  const TriMesh shell = test::joined(outer, test::flipped(test::box({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5})));
  EXPECT_EQ(mesh::WindingNumber(shell).at({0.1, 0.2, 0.3}).state, PointState::outside);
  expect_same_as_brute_force(shell, lattice(4, 0.25));
}

TEST(WindingNumber, OfAMeshInsideOutIsNegativeAndNobodyIsInside) {
  const TriMesh mesh = test::flipped(test::sphere(Vec3::Zero(), 1, 1));
  const auto at_centre = mesh::WindingNumber(mesh).at({0.1, 0.1, 0.1});
  EXPECT_EQ(at_centre.winding, -1);
  EXPECT_EQ(at_centre.state, PointState::outside);
  expect_same_as_brute_force(mesh, lattice(4, 0.25));
}

TEST(WindingNumber, OfARandomClosedTangleIsThatOfRationalArithmetic) {
  // Random triangles about one apex each, closed into tetrahedra on a coarse lattice: self-intersecting,
  // coplanar, touching, degenerate, both senses.
  std::mt19937 random(11);
  std::uniform_int_distribution<int> coordinate(-4, 4);
  int on_surface = 0, beyond_one = 0;
  for (int round = 0; round < 12; ++round) {
    TriMesh mesh;
    for (Index i = 0; i < 12; ++i) {
      for (int k = 0; k < 4; ++k)
        mesh.vertices.push_back(0.25 * Vec3(coordinate(random), coordinate(random), coordinate(random)));
      const Index v = 4 * i;
      mesh.triangles.insert(mesh.triangles.end(),
                            {{v, v + 2, v + 1}, {v, v + 1, v + 3}, {v + 1, v + 2, v + 3}, {v + 2, v, v + 3}});
    }
    Points points;
    for (int i = 0; i < 150; ++i) {
      points.push_back(0.25 * Vec3(coordinate(random), coordinate(random), coordinate(random)));
      points.push_back(0.125 * Vec3(coordinate(random), coordinate(random), coordinate(random)));
    }
    on_surface += expect_same_as_brute_force(mesh, points);
    for (const auto& w : mesh::WindingNumber(mesh).at(points)) beyond_one += std::abs(w.winding) > 1;
  }
  EXPECT_GT(on_surface, 100);
  EXPECT_GT(beyond_one, 10);
}

TEST(WindingNumber, StaysExactTenMetresFromTheOrigin) {
  const Vec3 away(1e4, -1e4, 1e4);
  const TriMesh mesh = test::sphere(away, 25, 2);
  Points points;
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    const Vec3 v = mesh.vertices[i];
    points.push_back(v);
    for (int axis = 0; axis < 3; ++axis) {
      Vec3 p = v;
      p[axis] = std::nextafter(p[axis], away[axis]);
      points.push_back(p);
    }
  }
  EXPECT_GE(expect_same_as_brute_force(mesh, points), static_cast<int>(mesh.vertices.size()));
}

TEST(WindingNumber, OfAMeshWithoutTrianglesOrHeightOrWidth) {
  EXPECT_EQ(mesh::WindingNumber(TriMesh{}).at({0, 0, 0}).winding, 0);
  // Two triangles back to back enclose nothing, but they are a surface.
  TriMesh flat = test::mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 1}});
  // The lattice points (0, 1/4, 1/2)^2 lie on them.
  EXPECT_EQ(expect_same_as_brute_force(flat, lattice(2, 0.25)), 9);
  flat = test::mapped(flat, [](const Vec3& p) { return Vec3(0, p.x(), p.y()); });
  EXPECT_EQ(expect_same_as_brute_force(flat, lattice(2, 0.25)), 9);
}

TEST(WindingNumber, AnOpenMeshIsRefusedNamingAnEdge) {
  TriMesh mesh = test::box({-1, -1, -1}, {1, 1, 1});
  mesh.triangles.pop_back();
  const std::string what = test::complaint_of<MeshError>([&] { mesh::WindingNumber refused(mesh); });
  test::expect_says(what, "edge from vertex");
  test::expect_silent(what, "\n");
}

TEST(WindingNumber, OfARealHipBoneAgreesWithRationalArithmetic) {
  FOUND_OR_SKIP(data, test::shared_data());
  const TriMesh bone = test::read_ply(*data / "hip_libhip_m1_left/coarse/hip_bone_2442.ply");
  const TriMesh femur = test::read_ply(*data / "hip_libhip_m1_left/coarse/femur_1542.ply");
  Points points;
  for (std::size_t i = 0; i < femur.vertices.size(); i += 40)
    points.push_back(femur.vertices[i] + Vec3(5, 20, -20));
  for (std::size_t i = 0; i < bone.vertices.size(); i += 200) points.push_back(bone.vertices[i]);
  EXPECT_EQ(expect_same_as_brute_force(bone, points), 7);
}

TEST(WindingNumber, IsTheSameForAnyNumberOfThreads) {
  const TriMesh mesh = test::torus(3, 1, 40, 20);
  Points points;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-4, 4);
  for (int i = 0; i < 5000; ++i) points.push_back({uniform(random), uniform(random), uniform(random) / 4});
  const mesh::WindingNumber winding(mesh);
  const auto many = winding.at(points);
  const core::ThreadLimit one(1);
  EXPECT_EQ(many, winding.at(points));
  EXPECT_GT(std::count_if(many.begin(), many.end(), [](const auto& w) { return w.winding == 1; }), 500);
}

}  // namespace
}  // namespace condyle
