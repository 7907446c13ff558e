#include "mesh/require_solid.hpp"

#include <gtest/gtest.h>

#include "condyle/error.hpp"
#include "support/test_meshes.hpp"

namespace condyle {
namespace {

std::string refusal(const TriMesh& mesh) {
  try {
    mesh::require_solid(mesh, "bone.ply");
  } catch (const MeshError& error) {
    return error.what();
  }
  return "";
}

TEST(RequireSolid, ASolidAndASolidWithACavityPass) {
  EXPECT_EQ(refusal(test::sphere({0, 0, 0}, 1, 2)), "");
  EXPECT_EQ(
      refusal(test::joined(test::box({-2, -2, -2}, {2, 2, 2}), test::flipped(test::sphere({0, 0, 0}, 1, 2)))),
      "");
}

TEST(RequireSolid, AnOpenMeshIsRefusedByFileAndBoundary) {
  TriMesh open = test::sphere({0, 0, 0}, 1, 1);
  open.triangles.pop_back();
  const std::string message = refusal(open);
  EXPECT_EQ(message.rfind("bone.ply: an open boundary of 3 edges", 0), 0u) << message;
  EXPECT_NE(message.find("intersecting triangle pairs can still be computed"), std::string::npos);
}

TEST(RequireSolid, InconsistentWindingIsRefusedByFileAndEdge) {
  TriMesh mesh = test::sphere({0, 0, 0}, 1, 1);
  std::swap(mesh.triangles[5][0], mesh.triangles[5][1]);
  EXPECT_NE(refusal(mesh).find("bone.ply: triangles wound against each other at the edge from vertex "),
            std::string::npos);
}

TEST(RequireSolid, AnInvertedMeshIsRefusedWithItsRepair) {
  EXPECT_NE(refusal(test::flipped(test::sphere({0, 0, 0}, 1, 1))).find("flip_inverted"), std::string::npos);
}

std::string refused_orientation(const TriMesh& mesh) {
  try {
    mesh::require_oriented(mesh, "bone.ply");
  } catch (const MeshError& error) {
    return error.what();
  }
  return "";
}

TEST(RequireOriented, AnOpenMeshPassesUnlessItsTrianglesAreWoundAgainstEachOther) {
  TriMesh mesh = test::sphere({0, 0, 0}, 1, 1);
  EXPECT_EQ(refused_orientation(mesh), "");
  EXPECT_NE(refused_orientation(test::flipped(mesh)).find("flip_inverted"), std::string::npos);
  mesh.triangles.pop_back();
  EXPECT_EQ(refused_orientation(mesh), "");
  std::swap(mesh.triangles[5][0], mesh.triangles[5][1]);
  EXPECT_TRUE(
      refused_orientation(mesh).starts_with("bone.ply: triangles wound against each other at the edge from "))
      << refused_orientation(mesh);
}

}  // namespace
}  // namespace condyle
