#include "kinematics/surface_points.hpp"
#include "support/test.hpp"

/// Means of normals over the points around, of surfaces that have many of them.

namespace condyle::kinematics {
namespace {

/// A flat cone up to the origin, without its base: every vertex of the rim is joined to the hub.
TriMesh cone(Index facets) {
  TriMesh mesh;
  mesh.vertices.push_back(Vec3::Zero());
  for (Index i = 0; i < facets; ++i) {
    const double angle = 2 * std::numbers::pi * i / facets;
    mesh.vertices.push_back(Vec3(std::cos(angle), std::sin(angle), -0.5));
    mesh.triangles.push_back({0, i + 1, (i + 1) % facets + 1});
  }
  return mesh;
}

std::vector<SurfacePoint> averaged(const TriMesh& mesh, double reach) {
  std::vector<SurfacePoint> points = surface_points(mesh, std::nullopt);
  PointNeighbours(mesh, points).average_normals(points, reach);
  return points;
}

TEST(AveragedNormals, OfAllPointsOfAConeAreItsAxis) {
  for (const SurfacePoint& point : averaged(cone(900), 10))
    EXPECT_LT((point.normal - Vec3::UnitZ()).norm(), 1e-12);
}

// The hub of a fan, a third of its area, and of the rim the thousand nearest, a sixtieth: what they face outwards is at most 1/20 of 1/sqrt(5).
TEST(AveragedNormals, OfAFanOfManyTrianglesAreThoseOfItsHubAndOfTheNearest) {
  for (const SurfacePoint& point : averaged(cone(40'000), 10)) {
    if (point.vertex == 0) continue;
    const Vec3 radial = Vec3(point.position.x(), point.position.y(), 0);
    EXPECT_LT(std::abs(point.normal.dot(Vec3(-radial.y(), radial.x(), 0))), 1e-9);
    EXPECT_GT(point.normal.dot(radial), 0.01);
    EXPECT_LT(point.normal.dot(radial), 0.05 / std::sqrt(5));
  }
}

}  // namespace
}  // namespace condyle::kinematics
