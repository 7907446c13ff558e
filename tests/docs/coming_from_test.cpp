#include <gtest/gtest.h>

#include "condyle/condyle.hpp"
#include "support/test_meshes.hpp"
#ifdef CONDYLE_TEST_FCL
#include <fcl/geometry/bvh/BVH_model.h>
#endif
#ifdef CONDYLE_TEST_CGAL
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#endif
#ifdef CONDYLE_TEST_BULLET
#include <BulletCollision/CollisionShapes/btTriangleIndexVertexArray.h>
#include <BulletCollision/CollisionShapes/btTriangleMesh.h>
#endif

/// The lines of docs/coming-from.md, as they stand there, take a box of another library that is sunk by 1.25 into ours.

namespace condyle::test {
namespace {

const TriMesh fixed = box({-10, -10, -10}, {10, 10, 10}), sunk = box({-3, -2, 0}, {3, 4, 5.25});

Pose sunk_by_1_25() {
  Pose X = Pose::Identity();
  X.translation() = Vec3(0, 0, 8.75);
  return X;
}
const Pose X_FM = sunk_by_1_25();

void expect_sunk(const TouchAnswer& answer) {
  for (const JointNote& note : answer.notes) EXPECT_EQ(note.code, JointNoteCode::unlikely_size) << note.text;
  ASSERT_TRUE(answer.deepest && answer.overlap);
  EXPECT_NEAR(answer.deepest->depth_mm, 1.25, 1e-12);
  EXPECT_NEAR(answer.overlap->volume_mm3.value(), 45, 1e-9);
}

TEST(ComingFrom, FclHasTheMeshInItsModel) {
#ifdef CONDYLE_TEST_FCL
  fcl::BVHModel<fcl::AABBd> model;
  model.beginModel();
  for (const Triangle& t : sunk.triangles) {
    const auto& v = sunk.vertices;
    model.addTriangle(v[t[0]], v[t[1]], v[t[2]]);
  }
  model.endModel();
#include "FCL.inc"
  expect_sunk(answer);
#else
  GTEST_SKIP() << "libfcl-dev is missing";
#endif
}

TEST(ComingFrom, CgalHasASurfaceMesh) {
#ifdef CONDYLE_TEST_CGAL
  CGAL::Surface_mesh<CGAL::Simple_cartesian<double>::Point_3> mesh;
  using Vertex = decltype(mesh)::Vertex_index;
  for (std::size_t v = 0; v < sunk.vertices.size(); ++v)
    mesh.add_vertex({sunk.vertices.x[v], sunk.vertices.y[v], sunk.vertices.z[v]});
  for (const Triangle& t : sunk.triangles) mesh.add_face(Vertex(t[0]), Vertex(t[1]), Vertex(t[2]));
#include "CGAL.inc"
  expect_sunk(answer);
#else
  GTEST_SKIP() << "libcgal-dev is missing";
#endif
}

#ifdef CONDYLE_TEST_BULLET
void expect_sunk_of(const btStridingMeshInterface& mesh) {
#include "Bullet.inc"
  expect_sunk(answer);
}
#endif

TEST(ComingFrom, BulletHasTrianglesOrArrays) {
#ifdef CONDYLE_TEST_BULLET
  btTriangleMesh triangles;
  std::vector<int> indices;
  std::vector<btScalar> coordinates;
  const auto corner = [&](Index v) {
    return btVector3(sunk.vertices.x[v], sunk.vertices.y[v], sunk.vertices.z[v]);
  };
  for (const Triangle& t : sunk.triangles) {
    triangles.addTriangle(corner(t[0]), corner(t[1]), corner(t[2]));
    for (const Index v : t) indices.push_back(static_cast<int>(v));
  }
  for (std::size_t v = 0; v < sunk.vertices.size(); ++v)
    coordinates.insert(coordinates.end(), {sunk.vertices.x[v], sunk.vertices.y[v], sunk.vertices.z[v]});
  expect_sunk_of(triangles);
  expect_sunk_of(btTriangleIndexVertexArray(static_cast<int>(sunk.triangles.size()), indices.data(),
                                            3 * sizeof(int), static_cast<int>(sunk.vertices.size()),
                                            coordinates.data(), 3 * sizeof(btScalar)));
#else
  GTEST_SKIP() << "libbullet-dev is missing";
#endif
}

}  // namespace
}  // namespace condyle::test
