#include "condyle/inspect.hpp"
#include "support/test.hpp"

namespace condyle {
namespace {

/// Every triangle with three vertices of its own.
TriMesh soup_of(const TriMesh& mesh) {
  TriMesh soup;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto first = static_cast<Index>(soup.vertices.size());
    for (int k = 0; k < 3; ++k) soup.vertices.push_back(mesh.corner(t, k));
    soup.triangles.push_back({first, first + 1, first + 2});
  }
  return soup;
}

/// The surface as its corners' coordinates, triangle by triangle: what a repair must not change.
std::vector<Vec3> corners_of(const TriMesh& mesh) {
  std::vector<Vec3> corners;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (int k = 0; k < 3; ++k) corners.push_back(mesh.corner(t, k));
  }
  return corners;
}

std::string complaint(TriMesh mesh) {
  const TriMesh before = mesh;
  const std::string said = test::complaint_of<MeshError>([&] { flip_inverted(mesh); });
  EXPECT_TRUE(said == "accepted" || mesh == before);
  return said;
}

TEST(ExactWeld, MakesASoupTheMeshItWas) {
  const TriMesh mesh = test::torus(30, 8, 24, 12);
  TriMesh soup = soup_of(mesh);
  const auto corners = corners_of(soup);
  EXPECT_EQ(weld_exactly(soup), 3 * mesh.triangles.size() - mesh.vertices.size());
  EXPECT_EQ(soup.vertices.size(), mesh.vertices.size());
  EXPECT_EQ(corners_of(soup), corners);
  EXPECT_TRUE(inspect(soup).is_closed());
  EXPECT_EQ(weld_exactly(soup), 0u);
}

TEST(ExactWeld, KnowsNoToleranceButTakesMinusZeroForZero) {
  TriMesh mesh =
      test::mesh_of({{0, 0, 1}, {-0.0, 0, 1}, {0x1p-1074, 0, 1}, {0, 0, std::nextafter(1, 2)}}, {{1, 2, 3}});
  EXPECT_EQ(weld_exactly(mesh), 1u);
  EXPECT_EQ(mesh.vertices.size(), 3u);
  EXPECT_FALSE(std::signbit(mesh.vertices.x[0]));
  EXPECT_EQ(mesh.triangles[0], (Triangle{0, 1, 2}));
}

TEST(ExactWeld, KeepsTheFirstOfEachInTheOrderOfTheFirsts) {
  std::mt19937 random(3);
  Points points;
  for (int i = 0; i < 500; ++i)
    points.push_back({double(random() % 4), double(random() % 4), double(random() % 4)});
  const auto first = first_of_same_coordinates(points);
  for (Index i = 0; i < points.size(); ++i) {
    Index expected = 0;
    while (points[expected] != points[i]) ++expected;
    ASSERT_EQ(first[i], expected);
  }
}

TEST(DropUnreferencedVertices, KeepsTheSurfaceAndTheOrder) {
  TriMesh mesh = test::joined(test::sphere({0, 0, 0}, 5, 1), test::box({1, 1, 1}, {2, 2, 2}));
  mesh.triangles.erase(mesh.triangles.begin(), mesh.triangles.end() - 12);
  const auto corners = corners_of(mesh);
  const std::size_t of_sphere = mesh.vertices.size() - 8;
  EXPECT_EQ(drop_unreferenced_vertices(mesh), of_sphere);
  EXPECT_EQ(mesh, test::box({1, 1, 1}, {2, 2, 2}));
  EXPECT_EQ(corners_of(mesh), corners);
  EXPECT_EQ(drop_unreferenced_vertices(mesh), 0u);
}

TEST(FlipInverted, TurnsAMeshOfInvertedOrientation) {
  const TriMesh good = test::torus(30, 8, 24, 12);
  TriMesh mesh = test::flipped(good);
  EXPECT_EQ(flip_inverted(mesh), good.triangles.size());
  EXPECT_EQ(mesh, good);
  EXPECT_EQ(flip_inverted(mesh), 0u);
  EXPECT_EQ(mesh, good);
}

TEST(FlipInverted, TurnsSeveralSolidsOnlyTogether) {
  const TriMesh a = test::box({0, 0, 0}, {1, 1, 1}), b = test::box({5, 0, 0}, {6, 1, 1});
  TriMesh both = test::flipped(test::joined(a, b));
  EXPECT_EQ(flip_inverted(both), 24u);
  EXPECT_EQ(both, test::joined(a, b));
  EXPECT_EQ(
      complaint(test::joined(a, test::flipped(b))),
      "1 component of 2 inverted, the first with triangle 12: not turned, as the boundary of a cavity is "
      "wound that way");
}

TEST(FlipInverted, RefusesWhatHasNoInside) {
  TriMesh open = test::flipped(test::box({0, 0, 0}, {1, 1, 1}));
  open.triangles.pop_back();
  EXPECT_EQ(complaint(open).rfind(
                "cannot decide whether the mesh is inverted: it has an open boundary of 3 edges near ", 0),
            0u);

  TriMesh mixed = test::box({0, 0, 0}, {1, 1, 1});
  std::swap(mixed.triangles[0][1], mixed.triangles[0][2]);
  EXPECT_EQ(complaint(mixed),
            "cannot decide whether the mesh is inverted: neighbours are wound differently at 3 edges");

  TriMesh doubled = test::box({0, 0, 0}, {1, 1, 1});
  doubled.triangles.insert(doubled.triangles.end(), doubled.triangles.begin(),
                           doubled.triangles.begin() + 12);
  doubled.triangles.push_back(doubled.triangles[3]);
  doubled.triangles.push_back(doubled.triangles[3]);
  EXPECT_EQ(complaint(doubled),
            "cannot decide whether the mesh is inverted: it has 3 unbalanced non-manifold edges");
}

TEST(FlipInverted, TurnsASurfaceThatIsThereTwice) {
  TriMesh doubled = test::box({0, 0, 0}, {1, 1, 1});
  doubled.triangles.insert(doubled.triangles.end(), doubled.triangles.begin(),
                           doubled.triangles.begin() + 12);
  TriMesh mesh = test::flipped(doubled);
  EXPECT_EQ(flip_inverted(doubled), 0u);
  EXPECT_EQ(flip_inverted(mesh), 24u);
  EXPECT_EQ(mesh, doubled);
}

}  // namespace
}  // namespace condyle
