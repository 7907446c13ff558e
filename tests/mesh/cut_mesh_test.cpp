#include "mesh/cut_mesh.hpp"

#include <numeric>

#include "condyle/inspect.hpp"
#include "mesh/enclosed_volume.hpp"
#include "mesh/plane_outline.hpp"
#include "support/test.hpp"

/// Meshes cut by planes into two closed ones.

namespace condyle::mesh {
namespace {

CutMesh cut_once(const TriMesh& mesh, const Vec3& point, const Vec3& normal) {
  const CuttingPlane plane{point, normal.normalized()};
  return cut_by_planes(Mesh(mesh), "bone", {&plane, 1});
}

double sum(const std::vector<double>& of) {
  return std::accumulate(of.begin(), of.end(), 0.0);
}

/// Both sides are closed, do not run through themselves, have the volume of the mesh together, and keep its vertices.
void expect_sound(const TriMesh& mesh, const CutMesh& cut, double rounding) {
  for (const CutSide* side : {&cut.inner, &cut.outer}) {
    const MeshReport report = inspect(Mesh(side->mesh));
    EXPECT_TRUE(report.is_closed());
    EXPECT_EQ(report.self_crossings.count, 0u);
    EXPECT_EQ(report.degenerate_triangles.count, 0u);
    EXPECT_EQ(report.inconsistent_edges.count, 0u);
    EXPECT_EQ(report.unreferenced_vertices.count, 0u);
    EXPECT_GT(report.signed_volume.value_or(0), 0);
    for (std::size_t v = 0; v < side->mesh.vertices.size(); ++v)
      if (side->vertex_before[v] != no_index) {
        EXPECT_EQ(side->mesh.vertices[v], mesh.vertices[side->vertex_before[v]]);
      }
  }
  EXPECT_NEAR(cut.inner_mm3 + cut.outer_mm3, enclosed_volume(mesh), rounding);
  EXPECT_EQ(cut.inner.cut_triangles, cut.outer.cut_triangles);
  double area = 0;
  const TriMesh& inner = cut.inner.mesh;
  for (std::size_t t = inner.triangles.size() - cut.inner.cut_triangles; t < inner.triangles.size(); ++t)
    area +=
        (inner.corner(t, 1) - inner.corner(t, 0)).cross(inner.corner(t, 2) - inner.corner(t, 0)).norm() / 2;
  EXPECT_NEAR(area, sum(cut.face_mm2), 1e-9 * (1 + area));
}

/// All corners of the faces lie in their planes, and those of the inner side look out of them.
void expect_flat(const CutMesh& cut, const std::vector<CuttingPlane>& planes) {
  const TriMesh& inner = cut.inner.mesh;
  for (std::size_t t = inner.triangles.size() - cut.inner.cut_triangles; t < inner.triangles.size(); ++t)
    EXPECT_TRUE(std::any_of(planes.begin(), planes.end(), [&](const CuttingPlane& plane) {
      for (int k = 0; k < 3; ++k)
        if (std::abs(plane.normal.dot(inner.corner(t, k) - plane.point)) > 2 * on_plane_mm) return false;
      return (inner.corner(t, 1) - inner.corner(t, 0))
                 .cross(inner.corner(t, 2) - inner.corner(t, 0))
                 .dot(plane.normal) > 0;
    })) << t;
}

constexpr double rounding_mm3 = 1e-9;

TEST(CutMesh, HalvesABoxWithTheVolumesOfTheBoxes) {
  const TriMesh box = test::box({0, 0, 0}, {10, 20, 30});
  const CutMesh cut = cut_once(box, {0, 0, 12}, {0, 0, 1});
  expect_sound(box, cut, rounding_mm3);
  expect_flat(cut, {{{0, 0, 12}, {0, 0, 1}}});
  EXPECT_NEAR(cut.inner_mm3, 10 * 20 * 12, rounding_mm3);
  EXPECT_NEAR(cut.face_mm2[0], 200, 1e-11);
  EXPECT_EQ(cut.pieces_behind, 1u);
  EXPECT_EQ(cut.outer_pieces, 1u);
}

TEST(CutMesh, CutsACornerOffABoxByThreePlanes) {
  const TriMesh box = test::box({0, 0, 0}, {10, 20, 30});
  const std::vector<CuttingPlane> planes = {
      {{4, 0, 0}, {1, 0, 0}}, {{0, 5, 0}, {0, 1, 0}}, {{0, 0, 6}, {0, 0, 1}}};
  std::vector<std::size_t> order = {0, 1, 2};
  do {
    std::vector<CuttingPlane> ordered;
    for (const std::size_t i : order) ordered.push_back(planes[i]);
    const CutMesh cut = cut_by_planes(Mesh(box), "bone", ordered);
    expect_sound(box, cut, rounding_mm3);
    expect_flat(cut, planes);
    EXPECT_NEAR(cut.inner_mm3, 4 * 5 * 6, rounding_mm3);
    EXPECT_NEAR(sum(cut.face_mm2), 4 * 5 + 5 * 6 + 4 * 6, 1e-11);
    // No walls in the rest: its surface is that of the box less what both have lost, and the faces.
    EXPECT_NEAR(inspect(Mesh(cut.outer.mesh)).area, 2 * (200 + 300 + 600), 1e-10);
  } while (std::next_permutation(order.begin(), order.end()));
}

TEST(CutMesh, ASlabOfASphereHasItsVolumeAndDiscs) {
  constexpr double radius = 25;
  const int levels = 5;
  const TriMesh ball = test::sphere({1, 2, 3}, radius, levels);
  // Zone of a ball between heights -5 and 12 about the centre; flat triangles sag by at most edge^2 / (8 radius).
  const std::vector<CuttingPlane> planes = {{{1, 2, 15}, {0, 0, 1}}, {{1, 2, -2}, {0, 0, -1}}};
  const CutMesh cut = cut_by_planes(Mesh(ball), "bone", planes);
  expect_sound(ball, cut, 1e-8);
  expect_flat(cut, planes);
  const auto cap = [&](double h) { return std::numbers::pi * (radius * radius * h - h * h * h / 3); };
  const double edge = inspect(Mesh(ball)).edge_lengths.longest, sag = edge * edge / (8 * radius);
  EXPECT_NEAR(cut.inner_mm3, cap(12) - cap(-5), 2 * std::numbers::pi * radius * 17 * sag);
  for (const auto& [face, height] : {std::pair(0, 12.0), std::pair(1, 5.0)}) {
    const double disc = std::numbers::pi * (radius * radius - height * height);
    EXPECT_NEAR(cut.face_mm2[face], disc, 2 * std::numbers::pi * radius * sag * 2);
    EXPECT_LT(cut.face_mm2[face], disc);
  }
  EXPECT_EQ(cut.outer_pieces, 2u);
}

TEST(CutMesh, FacesHaveHolesWhereTheMeshIsHollow) {
  const TriMesh shell =
      test::joined(test::box({-10, -10, -10}, {10, 10, 10}), test::flipped(test::sphere({0, 1, 0}, 6, 3)));
  const CutMesh cut = cut_once(shell, {0, 0, 0.5}, {0.1, 0.2, 1});
  expect_sound(shell, cut, rounding_mm3);
  EXPECT_EQ(cut.pieces_behind, 1u);
  const TriMesh tubes = test::torus(12, 4, 40, 24);
  // Along the ring: a face with a hole; across it: two faces.
  const CutMesh along = cut_once(tubes, {0, 0, 1}, {0, 0, 1}),
                across = cut_once(tubes, {0, 0, 0}, {1, 0.1, 0.05});
  expect_sound(tubes, along, rounding_mm3);
  expect_sound(tubes, across, rounding_mm3);
  EXPECT_EQ(inspect(Mesh(along.inner.mesh)).components.front().genus, 1);
  EXPECT_EQ(inspect(Mesh(across.inner.mesh)).components.front().genus, 0);
}

TEST(CutMesh, VerticesAndEdgesInAPlaneAreNoNewPoints) {
  // The six axis points and the circles between them are vertices and edges.
  const TriMesh ball = test::sphere({0, 0, 0}, 20, 3);
  const CutMesh cut = cut_once(ball, {0, 0, 0}, {0, 0, 1});
  expect_sound(ball, cut, rounding_mm3);
  EXPECT_EQ(std::count(cut.inner.vertex_before.begin(), cut.inner.vertex_before.end(), no_index), 0);
  EXPECT_NEAR(cut.inner_mm3, cut.outer_mm3, rounding_mm3);
  // Off by less than counts, and by more.
  EXPECT_EQ(cut_once(ball, {0, 0, on_plane_mm / 2}, {0, 0, 1}).inner.mesh, cut.inner.mesh);
  const CutMesh above = cut_once(ball, {0, 0, 4 * on_plane_mm}, {0, 0, 1});
  expect_sound(ball, above, rounding_mm3);
  EXPECT_GT(above.inner_mm3, cut.inner_mm3);
}

TEST(CutMesh, APlaneInAFaceOfTheMeshCutsOnTheSideOfItsSolid) {
  // An L of two boxes that share a face's plane: z = 10 is the top of the lower part and runs through the upper.
  const TriMesh low = test::box({0, 0, 0}, {10, 10, 10});
  TriMesh steps = test::mesh_of({{0, 0, 0},
                                 {20, 0, 0},
                                 {20, 10, 0},
                                 {0, 10, 0},
                                 {0, 0, 10},
                                 {10, 0, 10},
                                 {20, 0, 10},
                                 {20, 10, 10},
                                 {10, 10, 10},
                                 {0, 10, 10},
                                 {0, 0, 20},
                                 {10, 0, 20},
                                 {10, 10, 20},
                                 {0, 10, 20}},
                                {});
  const auto quad = [&](Index a, Index b, Index c, Index d) {
    steps.triangles.push_back({a, b, c});
    steps.triangles.push_back({a, c, d});
  };
  quad(0, 3, 2, 1);                                                            // bottom
  quad(5, 6, 7, 8);                                                            // step, in the plane
  quad(10, 11, 12, 13);                                                        // top
  quad(1, 2, 7, 6);                                                            // x = 20
  quad(5, 8, 12, 11);                                                          // x = 10
  quad(0, 4, 9, 3), quad(4, 10, 13, 9);                                        // x = 0
  quad(0, 1, 6, 5), quad(4, 5, 11, 10), steps.triangles.push_back({0, 5, 4});  // y = 0
  quad(2, 3, 9, 8), quad(8, 9, 13, 12), steps.triangles.push_back({2, 8, 7});  // y = 10
  ASSERT_TRUE(Mesh(steps).is_closed());
  ASSERT_NEAR(enclosed_volume(steps), 3000, 1e-9);
  const CutMesh cut = cut_once(steps, {0, 0, 10}, {0, 0, 1});
  expect_sound(steps, cut, rounding_mm3);
  EXPECT_NEAR(cut.inner_mm3, 2000, rounding_mm3);
  EXPECT_NEAR(cut.face_mm2[0], 100, 1e-11);
  // The other way round the lower part is the rest, and the step its own surface.
  const CutMesh turned = cut_once(steps, {0, 0, 10}, {0, 0, -1});
  expect_sound(steps, turned, rounding_mm3);
  EXPECT_NEAR(turned.inner_mm3, 1000, rounding_mm3);
  // With a second plane in a side of the upper part.
  const std::vector<CuttingPlane> both = {{{0, 0, 5}, {0, 0, 1}}, {{10, 0, 0}, {1, 0, 0}}};
  const CutMesh corner = cut_by_planes(Mesh(steps), "bone", both);
  expect_sound(steps, corner, rounding_mm3);
  EXPECT_NEAR(corner.inner_mm3, 500, rounding_mm3);
}

TEST(CutMesh, ThePlanesOfABoxesOwnSidesAreMissed) {
  const TriMesh box = test::box({0, 0, 0}, {10, 20, 30});
  const auto refused = [&](const std::vector<CuttingPlane>& planes) {
    return test::complaint_of<UsageError>([&] { cut_by_planes(Mesh(box), "bone", planes); });
  };
  const CuttingPlane middle{{0, 0, 12}, {0, 0, 1}};
  EXPECT_EQ(refused({{{0, 0, 30}, {0, 0, 1}}}), "plane 1 misses bone, which lies wholly on its inner side");
  EXPECT_EQ(refused({middle, {{0, 0, 40}, {0, 0, 1}}}),
            "plane 2 misses bone, which lies wholly on its inner side");
  EXPECT_EQ(refused({middle, {{0, 0, 30}, {0, 0, -1}}}),
            "plane 2 misses bone, which lies wholly on its outer side, where the normal points");
  EXPECT_EQ(refused({middle, {{0, 0, 20}, {0, 0, -1}}}),
            "nothing of bone lies on the inner side of planes 1 to 2");
  // One that cuts nothing more has no face, the same one again takes the face over.
  const CutMesh more =
      cut_by_planes(Mesh(box), "bone", std::vector<CuttingPlane>{middle, {{0, 0, 20}, {0, 0, 1}}});
  EXPECT_EQ(more.face_mm2[1], 0);
  const CutMesh twice = cut_by_planes(Mesh(box), "bone", std::vector<CuttingPlane>{middle, middle});
  expect_sound(box, twice, rounding_mm3);
  EXPECT_NEAR(sum(twice.face_mm2), 200, 1e-11);
}

TEST(CutMesh, OpenAndInvertedMeshesAreRefused) {
  TriMesh open = test::box({0, 0, 0}, {10, 20, 30});
  EXPECT_THROW(cut_once(test::flipped(open), {0, 0, 12}, {0, 0, 1}), MeshError);
  open.triangles.pop_back();
  EXPECT_THROW(cut_once(open, {0, 0, 12}, {0, 0, 1}), MeshError);
}

TEST(CutMesh, TheLargestPieceIsCutOffAndTheOthersStayAsTheyAre) {
  // A U: two legs above z = 10 of unlike height. Behind a plane that faces down both legs are behind.
  const TriMesh legs = test::joined(test::box({0, 0, 0}, {10, 10, 30}), test::box({20, 0, 0}, {30, 10, 20}));
  const CutMesh cut = cut_once(legs, {0, 0, 12}, {0, 0, -1});
  expect_sound(legs, cut, rounding_mm3);
  EXPECT_EQ(cut.pieces_behind, 2u);
  EXPECT_NEAR(cut.inner_mm3, 100 * 18, rounding_mm3);
  EXPECT_NEAR(cut.face_mm2[0], 100, 1e-11);
  // A cavity goes with what it is in.
  const TriMesh hollow = test::joined(legs, test::flipped(test::sphere({5, 5, 20}, 3, 1)));
  const CutMesh with = cut_once(hollow, {0, 0, 12}, {0, 0, -1});
  expect_sound(hollow, with, rounding_mm3);
  EXPECT_LT(with.inner_mm3, cut.inner_mm3);
  EXPECT_NEAR(with.outer_mm3, cut.outer_mm3, rounding_mm3);
}

TEST(CutMesh, AnyPlanesCutAnyBallSoundly) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> coordinate(-1, 1);
  const auto vector = [&] { return Vec3(coordinate(random), coordinate(random), coordinate(random)); };
  int cuts = 0;
  for (int round = 0; round < 40; ++round) {
    const TriMesh ball = round % 2 ? test::sphere({0, 0, 0}, 20, 3) : test::torus(14, 5, 36, 20);
    std::vector<CuttingPlane> planes;
    for (int k = 0; k <= round % 4; ++k) planes.push_back({8 * vector(), vector().normalized()});
    try {
      const CutMesh cut = cut_by_planes(Mesh(ball), "bone", planes);
      SCOPED_TRACE(round);
      ++cuts;
      expect_sound(ball, cut, 1e-8);
      expect_flat(cut, planes);
      // Behind all planes and nowhere else, but for pieces that stay.
      for (std::size_t v = 0; v < cut.inner.mesh.vertices.size(); ++v)
        for (const CuttingPlane& plane : planes)
          EXPECT_LT(plane.normal.dot(cut.inner.mesh.vertices[v] - plane.point), 2 * on_plane_mm);
      if (cut.pieces_behind == 1) {
        for (std::size_t v = 0; v < cut.outer.mesh.vertices.size(); ++v)
          EXPECT_TRUE(std::any_of(planes.begin(), planes.end(), [&](const CuttingPlane& plane) {
            return plane.normal.dot(cut.outer.mesh.vertices[v] - plane.point) > -2 * on_plane_mm;
          }));
      }
    } catch (const UsageError& error) {
      test::expect_says(error.what(), "bone");
      test::expect_silent(error.what(), "crosses itself");
    }
  }
  EXPECT_GT(cuts, 25);
}

TEST(PlaneOutline, IsFilledWithItsVerticesOnly) {
  // A square with two square holes, one of which meets it in a corner, and a square in a hole.
  Points points;
  std::vector<DirectedEdge> edges;
  const auto loop = [&](std::vector<Vec3> corners) {
    const auto first = static_cast<Index>(points.size());
    for (const Vec3& p : corners) points.push_back(p);
    for (std::size_t i = 0; i < corners.size(); ++i)
      edges.push_back({first + static_cast<Index>(i), first + static_cast<Index>((i + 1) % corners.size())});
  };
  loop({{0, 0, 1}, {10, 0, 1}, {10, 10, 1}, {5, 10, 1}, {0, 10, 1}});
  loop({{2, 2, 1}, {2, 8, 1}, {4, 8, 1}, {4, 2, 1}});
  loop({{2.5, 3, 1}, {3.5, 3, 1}, {3.5, 7, 1}, {2.5, 7, 1}});
  const auto corner = static_cast<Index>(points.size());
  points.push_back({7, 8, 1});
  points.push_back({8, 6, 1});
  edges.insert(edges.end(), {{2, corner + 1}, {corner + 1, corner}, {corner, 2}});
  const auto filled = filled_outline(points, edges, {0, 0, 1});
  ASSERT_TRUE(filled);
  double area = 0;
  for (const auto& [a, b, c] : *filled) {
    const Vec3 twice = (points[b] - points[a]).cross(points[c] - points[a]);
    EXPECT_GT(twice.z(), 0);
    area += twice.z() / 2;
  }
  const double notch =
      std::abs((Vec3(8, 6, 0) - Vec3(10, 10, 0)).cross(Vec3(7, 8, 0) - Vec3(10, 10, 0)).z()) / 2;
  EXPECT_NEAR(area, 100 - 12 + 4 - notch, 1e-12);
  // Crossed, and not closed.
  edges.front().to = 2, edges[1].from = 2;
  edges.pop_back();
  EXPECT_FALSE(filled_outline(points, edges, {0, 0, 1}));
}

}  // namespace
}  // namespace condyle::mesh
