#include "mesh/subdivide.hpp"

#include "core/thread_limit.hpp"
#include "support/test.hpp"

namespace condyle {
namespace {

double signed_volume(const TriMesh& mesh) {
  double sum = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    sum += mesh.corner(t, 0).dot(mesh.corner(t, 1).cross(mesh.corner(t, 2))) / 6;
  return sum;
}

TEST(Subdivide, OneTriangleBecomesFourInTheStatedOrder) {
  TriMesh mesh = test::mesh_of({{0, 0, 0}, {2, 0, 0}, {0, 2, 0}}, {{0, 1, 2}});
  const TriMesh finer = mesh::subdivided(mesh);
  // Edges ascending: (0, 1), (0, 2), (1, 2) become vertices 3, 4, 5.
  ASSERT_EQ(finer.vertices.size(), 6u);
  EXPECT_EQ(finer.vertices[3], Vec3(1, 0, 0));
  EXPECT_EQ(finer.vertices[4], Vec3(0, 1, 0));
  EXPECT_EQ(finer.vertices[5], Vec3(1, 1, 0));
  const std::vector<Triangle> expected = {{0, 3, 4}, {3, 1, 5}, {4, 5, 2}, {3, 5, 4}};
  EXPECT_EQ(finer.triangles, expected);
}

TEST(Subdivide, NeighboursShareTheirMidpointAndTheSurfaceStays) {
  for (const TriMesh& mesh : {test::box(Vec3(-1, -2, -3), Vec3(4, 5, 6)), test::torus(4, 1, 12, 8)}) {
    const TriMesh finer = mesh::subdivided(mesh);
    EXPECT_EQ(finer.triangles.size(), 4 * mesh.triangles.size());
    EXPECT_EQ(finer.vertices.size(), mesh.vertices.size() + 3 * mesh.triangles.size() / 2);
    std::set<std::pair<Index, Index>> directed;
    for (const auto& t : finer.triangles) {
      for (int k = 0; k < 3; ++k) EXPECT_TRUE(directed.emplace(t[k], t[(k + 1) % 3]).second);
    }
    for (const auto& [a, b] : directed) EXPECT_TRUE(directed.contains({b, a}));
    EXPECT_NEAR(signed_volume(finer), signed_volume(mesh), 1e-12 * std::abs(signed_volume(mesh)));
  }
}

TEST(Subdivide, MidpointsGoWhereTheyArePlacedAndOldVerticesStay) {
  const TriMesh mesh = test::sphere(Vec3::Zero(), 2, 1);
  const TriMesh finer = mesh::subdivided(mesh, [](const Vec3& p) { return Vec3(2 * p.normalized()); });
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) EXPECT_EQ(finer.vertices[v], mesh.vertices[v]);
  for (std::size_t v = 0; v < finer.vertices.size(); ++v) EXPECT_NEAR(finer.vertices[v].norm(), 2, 1e-15);
}

TEST(Subdivide, OpenAndNonManifoldEdgesStayShared) {
  // Three triangles on one edge, as in a book with three pages.
  TriMesh mesh = test::mesh_of({{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {-1, -1, 0}},
                               {{0, 1, 2}, {0, 1, 3}, {1, 0, 4}});
  const TriMesh finer = mesh::subdivided(mesh);
  EXPECT_EQ(finer.vertices.size(), 5u + 7u);
  const auto users = std::count_if(finer.triangles.begin(), finer.triangles.end(), [](const Triangle& t) {
    return std::find(t.begin(), t.end(), Index{5}) != t.end();
  });
  EXPECT_EQ(users, 9);
}

TEST(Subdivide, NothingBecomesNothing) {
  EXPECT_EQ(mesh::subdivided(TriMesh{}), TriMesh{});
}

TEST(Subdivide, OneThreadGivesTheSameBytesAsMany) {
  const TriMesh mesh = test::sphere(Vec3(1, 2, 3), 5, 4);
  const auto place = [](const Vec3& p) { return Vec3(Vec3(1, 2, 3) + 5 * (p - Vec3(1, 2, 3)).normalized()); };
  const TriMesh many = mesh::subdivided(mesh, place);
  const core::ThreadLimit one_thread(1);
  EXPECT_EQ(mesh::subdivided(mesh, place), many);
}

}  // namespace
}  // namespace condyle
