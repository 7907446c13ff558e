#include "mesh/surface_distance.hpp"

#include "support/test.hpp"

namespace condyle {
namespace {

TEST(SurfaceDistance, ToATriangleItIsToFaceEdgeOrCorner) {
  const mesh::TriangleCorners t = {Vec3(0, 0, 0), Vec3(4, 0, 0), Vec3(0, 4, 0)};
  EXPECT_DOUBLE_EQ(mesh::distance_to_triangle({1, 1, -3}, t), 3);              // face
  EXPECT_DOUBLE_EQ(mesh::distance_to_triangle({2, -2, 0}, t), 2);              // edge, in the plane
  EXPECT_DOUBLE_EQ(mesh::distance_to_triangle({3, 3, 0}, t), std::sqrt(2.0));  // the long edge
  EXPECT_DOUBLE_EQ(mesh::distance_to_triangle({-3, 0, 4}, t), 5);              // corner
  EXPECT_DOUBLE_EQ(mesh::distance_to_triangle({1, 2, 0}, t), 0);               // on it
  EXPECT_DOUBLE_EQ(mesh::distance_to_triangle({1, 1, 0}, {Vec3(0, 0, 0), Vec3(2, 0, 0), Vec3(1, 0, 0)}),
                   1);  // no area
}

TEST(SurfaceDistance, ToABoxItIsTheClosedForm) {
  const TriMesh mesh = test::box({-1, -2, -3}, {1, 2, 3});
  const mesh::SurfaceDistance distance(mesh);
  EXPECT_DOUBLE_EQ(distance({0.5, 0, 0}), 0.5);
  EXPECT_DOUBLE_EQ(distance({4, 6, 0}), 5);
  EXPECT_DOUBLE_EQ(distance({1, 2, 3}), 0);
}

TEST(SurfaceDistance, TheTreeFindsWhatAllTrianglesGive) {
  const TriMesh mesh = test::torus(5, 1, 24, 12);
  const mesh::SurfaceDistance distance(mesh);
  std::mt19937 random(4);
  std::uniform_real_distribution<double> uniform(-7, 7);
  for (int i = 0; i < 500; ++i) {
    const Vec3 p(uniform(random), uniform(random), uniform(random) / 3);
    double least = 1e9;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      least = std::min(
          least, mesh::distance_to_triangle(p, {mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2)}));
    }
    EXPECT_EQ(distance(p), least);
  }
}

// Triangles that cannot be nearer are not measured, by their corners: the same bits as all of them give, from near and far.
TEST(SurfaceDistance, LeavesOutNoTriangleThatIsNearest) {
  const TriMesh mesh = test::torus(5, 1, 96, 48);
  const mesh::SurfaceDistance distance(mesh);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (const double scale : {1.0, 5.0, 7.0, 1e3, 1e9})
    for (int i = 0; i < 40; ++i) {
      const Vec3 p = scale * Vec3(uniform(random), uniform(random), uniform(random));
      double least = std::numeric_limits<double>::infinity();
      for (Index t = 0; t < mesh.triangles.size(); ++t)
        least = std::min(
            least, mesh::distance_to_triangle(p, {mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2)}));
      EXPECT_EQ(distance(p), least);
    }
}

}  // namespace
}  // namespace condyle
