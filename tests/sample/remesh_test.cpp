#include "sample/remesh.hpp"

#include "mesh/editable_mesh.hpp"
#include "sample/contour.hpp"
#include "sample/edge_queue.hpp"
#include "sample/projection.hpp"
#include "sample/self_intersection.hpp"
#include "sample/solid_mesh.hpp"
#include "sample/topology.hpp"
#include "support/test.hpp"

namespace condyle::sample {
namespace {

using mesh::EditableMesh;

const Sizing even = [](const Vec3&) { return 1.0; };

Solid ball_solid(const Vec3& centre, double radius) {
  const Vec3 room = Vec3::Constant(radius + 3);
  return {[=](const Vec3& p) { return ball({centre, radius}, p); }, {centre - room, centre + room}, {}};
}

/// Two balls joined by a bar bent into a ring.
Solid ring_solid() {
  const auto ring = [](const Vec3& p) {
    const double along = std::hypot(p.x(), p.y());
    const Vec3 core = along > 0 ? Vec3(20 / along * p.x(), 20 / along * p.y(), 0) : Vec3(20, 0, 0);
    return ball({core, 7}, p);
  };
  return {ring, {Vec3(-30, -30, -10), Vec3(30, 30, 10)}, {}};
}

TEST(Contour, IsClosedAndOutwardWithVerticesBetweenInsideAndOutside) {
  const TriMesh mesh = contoured(ring_solid(), 1.7);
  test::expect_sound(mesh, 1);
  // A vertex lies on a lattice edge that the surface crosses: within the longest edge, the cube's diagonal.
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    EXPECT_LT(std::abs(ring_solid().field(mesh.vertices[v]).value), 1.7 * std::sqrt(3.0));
  }
}

TEST(Contour, KeepsVerticesApartWhereTheSurfacePassesThroughLatticePoints) {
  // Radius and centre are multiples of the spacing: six lattice points lie on the sphere exactly, and many
  // more nearly.
  const Solid solid = ball_solid(Vec3::Zero(), 5);
  const TriMesh mesh = contoured(solid, 1);
  test::expect_sound(mesh, 0);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    EXPECT_NE(mesh.corner(t, 0), mesh.corner(t, 1));
    EXPECT_NE(mesh.corner(t, 1), mesh.corner(t, 2));
  }
}

TEST(Contour, RefusesASurfaceThatLeavesTheBox) {
  Solid solid = ball_solid(Vec3::Zero(), 5);
  solid.box.high.z() = 2;
  EXPECT_THROW(contoured(solid, 1), MeshError);
}

TEST(EdgeQueue, TheShortestIsFirstWhateverWasPushedInBetween) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> length(0, 3);  // some longer than the queue was made for
  EdgeQueue queue(2);
  std::set<EdgeQueue::Edge> waiting;
  int taken = 0;
  for (Index i = 0; i < 20000 || !waiting.empty(); ++i) {
    if (i < 20000 && i % 3 != 2) {
      // Few lengths in the first range: equal ones are distinguished by their vertices.
      const EdgeQueue::Edge edge = {i % 2 ? length(random) : 0.25 * (i % 5), i % 7, i};
      waiting.insert(edge), queue.push(edge);
      continue;
    }
    ASSERT_FALSE(queue.empty());
    ASSERT_EQ(queue.pop(), *waiting.begin());
    waiting.erase(waiting.begin());
    ++taken;
  }
  EXPECT_TRUE(queue.empty());
  EXPECT_GT(taken, 10000);
}

TEST(EditableMesh, RandomEditsKeepTheMeshSound) {
  std::mt19937 random(5);
  for (const auto& [start, genus] :
       {std::pair{test::sphere(Vec3::Zero(), 1, 2), 0}, {test::torus(4, 1, 12, 8), 1}}) {
    EditableMesh mesh(start);
    int collapses = 0, flips = 0, refused = 0;
    for (int i = 0; i < 600; ++i) {
      const auto edges = mesh.edges();
      const auto [a, b] = edges[std::uniform_int_distribution<std::size_t>(0, edges.size() - 1)(random)];
      const auto edge = mesh.star(a, b);
      ASSERT_TRUE(edge);
      const Vec3 middle = (mesh.position(a) + mesh.position(b)) / 2;
      const int kind = std::uniform_int_distribution<int>(0, 3)(random);
      if (kind <= 1) {
        mesh.can_collapse(*edge) ? (mesh.collapse(*edge, middle), ++collapses) : ++refused;
      } else if (kind == 2) {
        mesh.can_flip(*edge) ? (mesh.flip(*edge), ++flips) : ++refused;
      } else {
        mesh.split(*edge, middle);
      }
      const TriMesh packed = mesh.packed();
      ASSERT_EQ(packed.vertices.size(), mesh.vertex_count());
      const auto found = test::topology(packed);
      ASSERT_TRUE(found.is_closed_and_consistent && found.has_manifold_vertices);
      ASSERT_EQ(found.genus, genus);
      ASSERT_EQ(found.components, 1);
    }
    EXPECT_GT(collapses, 100);
    EXPECT_GT(flips, 50);
    EXPECT_GT(refused, 0);
  }
}

TEST(EditableMesh, ATetrahedronCannotShrink) {
  TriMesh tetrahedron;
  for (const Vec3& p : {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)})
    tetrahedron.vertices.push_back(p);
  tetrahedron.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  const EditableMesh mesh(tetrahedron);
  for (const auto& [a, b] : mesh.edges()) {
    EXPECT_FALSE(mesh.can_collapse(*mesh.star(a, b)));
    EXPECT_FALSE(mesh.can_flip(*mesh.star(a, b)));
  }
  EXPECT_FALSE(mesh.star(0, 0));
}

TEST(Remesh, ReachesAnyCountOnABallWithNearEquilateralTriangles) {
  const Solid solid = ball_solid(Vec3(3, -2, 1), 20);
  const TriMesh start = contoured(solid, 2.3);
  for (const std::size_t count : {100u, 101u, 517u, 1500u}) {
    const TriMesh mesh = remeshed(start, solid.field, even, count);
    EXPECT_EQ(mesh.vertices.size(), count);
    EXPECT_EQ(mesh.triangles.size(), 2 * count - 4);
    test::expect_sound(mesh, 0);
    EXPECT_FALSE(first_self_intersection(mesh));
    EXPECT_GT(test::smallest_angles_deg(mesh).front(), 30);
    for (std::size_t v = 0; v < count; ++v)
      EXPECT_NEAR((mesh.vertices[v] - Vec3(3, -2, 1)).norm(), 20, laid_tolerance);
  }
}

TEST(Remesh, SizingMakesEdgesShorterWhereAsked) {
  const Solid solid = ball_solid(Vec3::Zero(), 20);
  const Sizing finer_above = [](const Vec3& p) { return p.z() > 0 ? 0.5 : 1.0; };
  const TriMesh mesh = remeshed(contoured(solid, 1.1), solid.field, finer_above, 1000);
  double above = 0, below = 0;
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) (mesh.vertices[v].z() > 0 ? above : below) += 1;
  // Half the edge length is four times the vertices; the transition blurs it.
  EXPECT_NEAR(above / below, 4, 0.8);
}

TEST(Remesh, KeepsTheHoleOfARing) {
  const Solid solid = ring_solid();
  const TriMesh mesh = meshed(solid, {even, 1.5, 200}, 402);
  EXPECT_EQ(mesh.triangles.size(), 402u);
  test::expect_sound(mesh, 1);
}

TEST(Remesh, FinerMeshesAreSubdivisionsOrReachTheirCountBySplits) {
  const Solid solid = ring_solid();
  const Meshing meshing = {even, 1.5, 200};
  const TriMesh base = meshed(solid, meshing, 400), exact = meshed(solid, meshing, 1600);
  for (std::size_t v = 0; v < base.vertices.size(); ++v) EXPECT_EQ(base.vertices[v], exact.vertices[v]);
  const TriMesh more = meshed(solid, meshing, 1606);
  EXPECT_EQ(more.triangles.size(), 1606u);
  test::expect_sound(more, 1);
  EXPECT_FALSE(first_self_intersection(more));
}

}  // namespace
}  // namespace condyle::sample
