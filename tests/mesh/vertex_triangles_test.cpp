#include "mesh/vertex_triangles.hpp"

#include "support/test.hpp"

namespace condyle {
namespace {

TEST(VertexTriangles, EachVertexHasTheTrianglesThatItIsACornerOf) {
  const TriMesh mesh = test::torus(2, 0.5, 9, 7);
  const mesh::VertexTriangles at(mesh);
  for (Index v = 0; v < mesh.vertices.size(); ++v) {
    std::vector<Index> expected;
    for (Index t = 0; t < mesh.triangles.size(); ++t)
      for (const Index corner : mesh.triangles[t])
        if (corner == v) expected.push_back(t);
    EXPECT_EQ(std::vector<Index>(at.of(v).begin(), at.of(v).end()), expected);
  }
}

TEST(VertexTriangles, OfSeveralVerticesEachTriangleComesOnce) {
  TriMesh mesh;
  mesh.vertices = Points(5);
  mesh.triangles = {{0, 1, 2}, {2, 1, 3}, {0, 2, 3}};
  const mesh::VertexTriangles at(mesh);
  const std::vector<Index> asked = {3, 1, 4};
  EXPECT_EQ(at.of(asked), (std::vector<Index>{0, 1, 2}));
  EXPECT_EQ(at.of(std::vector<Index>{4}), std::vector<Index>{});
}

}  // namespace
}  // namespace condyle
