#include "condyle/inspect.hpp"

#include "support/sound_mesh.hpp"
#include "support/test.hpp"

namespace condyle {
namespace {

void expect_sound_outwards(const MeshReport& report) {
  test::expect_sound(report);
  EXPECT_EQ(report.inverted_components.count, 0u);
}

using test::mesh_of, test::shifted_by;

TriMesh without_triangle(TriMesh mesh, std::size_t t) {
  mesh.triangles.erase(mesh.triangles.begin() + static_cast<std::ptrdiff_t>(t));
  return mesh;
}

TEST(Inspect, ABoxIsSoundAndMeasuresWhatItMeasures) {
  const auto report = inspect(test::box({1, 2, 3}, {2, 4, 6}));
  expect_sound_outwards(report);
  EXPECT_EQ(report.vertices, 8u);
  EXPECT_EQ(report.triangles, 12u);
  EXPECT_EQ(report.signed_volume, 6);
  EXPECT_EQ(report.area, 2 * (2 + 3 + 6));
  EXPECT_EQ(report.bounds.low, Vec3(1, 2, 3));
  EXPECT_EQ(report.bounds.high, Vec3(2, 4, 6));
  ASSERT_EQ(report.components.size(), 1u);
  EXPECT_EQ(report.components[0].genus, 0);
  // 18 edges: four each of 1, 2 and 3, and two diagonals each of sqrt 5, sqrt 10 and sqrt 13; in order the
  // ninth and tenth are sqrt 5 and sqrt 5.
  EXPECT_EQ(report.edge_lengths.shortest, 1);
  EXPECT_EQ(report.edge_lengths.median, std::sqrt(5.0));
  EXPECT_EQ(report.edge_lengths.longest, std::sqrt(13.0));
}

TEST(Inspect, GenusCountsHandles) {
  EXPECT_EQ(inspect(test::sphere({0, 0, 0}, 10, 3)).components.at(0).genus, 0);
  EXPECT_EQ(inspect(test::torus(10, 3, 16, 8)).components.at(0).genus, 1);
  EXPECT_EQ(inspect(test::socket({0, 0, 0}, 20, 25, 3)).components.at(0).genus, 0);

  // Two tori glued where a triangle of each was cut out: genus 2.
  TriMesh a = test::torus(10, 3, 16, 8);
  const TriMesh b = shifted_by(test::torus(10, 3, 16, 8), {50, 0, 0});
  const auto offset = static_cast<Index>(a.vertices.size());
  const Triangle hole_a = a.triangles[0], hole_b = b.triangles[0];
  TriMesh both = test::joined(without_triangle(a, 0), without_triangle(b, 0));
  for (auto& triangle : both.triangles) {
    for (auto& v : triangle) {
      if (v == offset + hole_b[0])
        v = hole_a[0];
      else if (v == offset + hole_b[1])
        v = hole_a[2];
      else if (v == offset + hole_b[2])
        v = hole_a[1];
    }
  }
  const auto report = inspect(both);
  EXPECT_TRUE(report.is_closed());
  ASSERT_EQ(report.components.size(), 1u);
  EXPECT_EQ(report.components[0].genus, 2);
}

/// Both meshes have the same coordinates relative to their boxes' centres, but for the rounding of the
/// centres, which changes no volume. A tetrahedron's determinant of those errs by less than 8 u size^3 (see
/// filtered_determinant), the sum by less than its terms do; about the origin instead, it would err by 8 u
/// (16 m)^3, half a billion times as much.
TEST(Inspect, TheVolumeLosesNothingTenMetresFromTheOrigin) {
  const double size = 20;
  const TriMesh here = test::sphere({0, 0, 0}, size, 4);
  TriMesh there = here;
  for (auto* axis : {&there.vertices.x, &there.vertices.y, &there.vertices.z}) {
    for (double& value : *axis) value = (value + 0x1p14) - 0x1p14;  // exact to move by 2^14 mm = 16 m
  }
  const TriMesh far = shifted_by(there, {0x1p14, -0x1p14, 0x1p14});
  const double bound = 2 * 8 * 0x1p-53 * size * size * size / 6 * static_cast<double>(here.triangles.size());
  EXPECT_NEAR(*inspect(far).signed_volume,
              *inspect(shifted_by(far, {-0x1p14, 0x1p14, -0x1p14})).signed_volume, bound);
}

TEST(Inspect, AHoleIsNamedByItsRim) {
  const TriMesh sphere = test::sphere({0, 0, 0}, 30, 2);
  const auto report = inspect(without_triangle(sphere, 5));
  EXPECT_FALSE(report.is_closed());
  EXPECT_EQ(report.boundary_edges.count, 3u);
  EXPECT_EQ(report.boundary_loops.count, 1u);
  EXPECT_EQ(report.boundary_loops.first->edges, 3u);
  const Vec3 middle = (sphere.corner(5, 0) + sphere.corner(5, 1) + sphere.corner(5, 2)) / 3;
  EXPECT_LT((report.boundary_loops.first->centre - middle).norm(), 1e-13 * 30);
  EXPECT_FALSE(report.signed_volume.has_value());
  EXPECT_FALSE(report.components.at(0).genus.has_value());
  EXPECT_FALSE(report.components.at(0).closed);
}

TEST(Inspect, ABoundaryIsDescribedInALine) {
  const TriMesh square = mesh_of({{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}}, {{0, 1, 2}, {0, 2, 3}});
  EXPECT_EQ(describe_boundary(inspect(square)), "an open boundary of 4 edges near (1, 1, 0), from vertex 0");
  EXPECT_EQ(describe_boundary(inspect(test::joined(square, shifted_by(square, {9, 0, 0})))),
            "an open boundary of 4 edges near (1, 1, 0), from vertex 0 (the first of 2)");
  EXPECT_EQ(describe_boundary(inspect(test::box({0, 0, 0}, {1, 1, 1}))), "");
}

TEST(Inspect, ThreeTrianglesOnAnEdgeAreNonManifold) {
  const auto report = inspect(
      mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}}, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}));
  EXPECT_EQ(report.non_manifold_edges.count, 1u);
  EXPECT_EQ(report.non_manifold_edges.first, (Edge{0, 1}));
  EXPECT_EQ(report.boundary_edges.count, 6u);
  // All three hang together over the edge: the vertices have one fan each, if a branched one.
  EXPECT_EQ(report.non_manifold_vertices.count, 0u);
  EXPECT_EQ(report.components.size(), 1u);
}

TEST(Inspect, TwoSolidsThatTouchInAVertexAreTwoComponentsAndStillClosed) {
  const TriMesh box = test::box({0, 0, 0}, {1, 1, 1});
  TriMesh both = test::joined(box, test::box({1, 1, 1}, {2, 2, 2}));
  for (auto& triangle : both.triangles) std::replace(triangle.begin(), triangle.end(), Index{8}, Index{7});
  const auto report = inspect(both);
  EXPECT_EQ(report.non_manifold_vertices.count, 1u);
  EXPECT_EQ(report.non_manifold_vertices.first, 7u);
  EXPECT_TRUE(report.is_closed());
  EXPECT_EQ(report.signed_volume, 2);
  ASSERT_EQ(report.components.size(), 2u);
  EXPECT_EQ(report.components[0].genus, 0);
  EXPECT_EQ(report.components[1].genus, 0);
  EXPECT_EQ(report.components[1].first_triangle, 12u);
  EXPECT_EQ(report.unreferenced_vertices.first, 8u);
}

TEST(Inspect, ATriangleWoundTheOtherWayIsInconsistentOnItsThreeEdges) {
  TriMesh box = test::box({0, 0, 0}, {1, 1, 1});
  std::swap(box.triangles[4][1], box.triangles[4][2]);
  const auto report = inspect(box);
  EXPECT_EQ(report.inconsistent_edges.count, 3u);
  EXPECT_EQ(report.boundary_edges.count, 0u);
  EXPECT_FALSE(report.is_closed());
  const auto& first = *report.inconsistent_edges.first;
  const auto& turned = box.triangles[4];
  EXPECT_NE(std::find(turned.begin(), turned.end(), first.from), turned.end());
  EXPECT_NE(std::find(turned.begin(), turned.end(), first.to), turned.end());
}

TEST(Inspect, AMeshOfInvertedOrientationHasNegativeVolume) {
  const auto report = inspect(test::flipped(test::box({0, 0, 0}, {1, 2, 3})));
  EXPECT_TRUE(report.is_closed());
  EXPECT_EQ(report.signed_volume, -6);
  EXPECT_EQ(report.inverted_components.count, 1u);
  EXPECT_EQ(report.inverted_components.first, 0u);
}

TEST(Inspect, ACavityTakesItsVolumeAway) {
  const auto report = inspect(
      test::joined(test::box({0, 0, 0}, {10, 10, 10}), test::flipped(test::box({4, 4, 4}, {5, 5, 5}))));
  EXPECT_TRUE(report.is_closed());
  EXPECT_EQ(report.signed_volume, 999);
  EXPECT_EQ(report.inverted_components.count, 1u);
  EXPECT_EQ(report.inverted_components.first, 1u);
}

TEST(Inspect, DuplicateTrianglesAreTheLaterOnesInAnyOrderOfCorners) {
  TriMesh box = test::box({0, 0, 0}, {1, 1, 1});
  const auto [a, b, c] = box.triangles[3];
  box.triangles.insert(box.triangles.begin() + 6, {c, a, b});
  box.triangles.push_back({b, a, c});
  const auto report = inspect(box);
  EXPECT_EQ(report.duplicate_triangles.count, 2u);
  EXPECT_EQ(report.duplicate_triangles.first, 6u);
  EXPECT_EQ(report.non_manifold_edges.count, 3u);
}

TEST(Inspect, DegenerateMeansAnAreaOfExactlyZero) {
  const double tiny = std::numeric_limits<double>::denorm_min();
  const auto report = inspect(mesh_of({{0, 0, 0},
                                       {1, 1, 1},
                                       {3, 3, 3},            // on the line through the first two
                                       {3, 3, 3 + 0x1p-51},  // one bit beside it
                                       {0, 0, tiny},
                                       {0, tiny, 0}},
                                      {{0, 1, 2}, {0, 1, 3}, {0, 4, 5}, {0, 1, 1}}));
  EXPECT_EQ(report.degenerate_triangles.count, 2u);
  EXPECT_EQ(report.degenerate_triangles.first, 0u);
}

TEST(Inspect, ATriangleThatNamesAVertexTwiceOpensNothing) {
  TriMesh box = test::box({0, 0, 0}, {1, 1, 1});
  box.triangles.push_back({0, 1, 1});
  box.triangles.push_back({3, 3, 3});
  const auto report = inspect(box);
  EXPECT_TRUE(report.is_closed());
  EXPECT_EQ(report.degenerate_triangles.count, 2u);
  EXPECT_EQ(report.degenerate_triangles.first, 12u);
  EXPECT_EQ(report.non_manifold_vertices.count, 0u);
  EXPECT_EQ(report.signed_volume, 1);
  EXPECT_EQ(report.components.size(), 1u);
}

TEST(Inspect, UnreferencedAndDuplicateVerticesAreCountedAndDoNotWidenTheBox) {
  TriMesh box = test::box({0, 0, 0}, {1, 1, 1});
  box.vertices.push_back({-0.0, 1, 0});
  box.vertices.push_back({100, 100, 100});
  const auto report = inspect(box);
  EXPECT_EQ(report.unreferenced_vertices.count, 2u);
  EXPECT_EQ(report.unreferenced_vertices.first, 8u);
  EXPECT_EQ(report.duplicate_vertices.count, 1u);
  EXPECT_EQ(report.duplicate_vertices.first, 8u);
  EXPECT_EQ(report.bounds.high, Vec3(1, 1, 1));
}

TEST(Inspect, TheUnitIsGuessedFromTheSizeOfABone) {
  const auto unit_of = [](double edge) {
    return inspect(test::box({0, 0, 0}, {edge, 1e-9, 1e-9})).likely_unit;
  };
  EXPECT_EQ(unit_of(450).unit, LengthUnit::millimetres);
  EXPECT_EQ(unit_of(0.45).unit, LengthUnit::metres);
  EXPECT_EQ(unit_of(20.001).unit, LengthUnit::millimetres);
  EXPECT_EQ(unit_of(19.999).unit, std::nullopt);
  EXPECT_EQ(unit_of(0.999).unit, LengthUnit::metres);
  EXPECT_EQ(unit_of(1.001).unit, std::nullopt);
  EXPECT_EQ(unit_of(0.0199).unit, std::nullopt);
  EXPECT_EQ(unit_of(1001).unit, std::nullopt);
  EXPECT_EQ(unit_of(450).reason, "the bounding box is 450 across: a bone in millimetres");
}

TEST(Inspect, AMeshWithoutTrianglesIsClosedAndEnclosesNothing) {
  const auto report = inspect(mesh_of({{1, 2, 3}}, {}));
  EXPECT_TRUE(report.is_closed());
  EXPECT_EQ(report.signed_volume, 0);
  EXPECT_EQ(report.unreferenced_vertices.count, 1u);
  EXPECT_TRUE(report.components.empty());
}

TEST(Inspect, TwoSolidsThatShareAnEdgeAreOneClosedComponentWithoutGenus) {
  TriMesh two = test::joined(test::box({0, 0, 0}, {1, 1, 1}), test::box({1, 1, 0}, {2, 2, 1}));
  for (auto& triangle : two.triangles) {
    std::replace(triangle.begin(), triangle.end(), Index{8}, Index{3});
    std::replace(triangle.begin(), triangle.end(), Index{12}, Index{7});
  }
  const auto report = inspect(two);
  EXPECT_TRUE(report.is_closed());
  EXPECT_EQ(report.non_manifold_edges.count, 1u);
  EXPECT_EQ(report.unbalanced_edges.count, 0u);
  EXPECT_EQ(report.signed_volume, 2);
  ASSERT_EQ(report.components.size(), 1u);
  EXPECT_TRUE(report.components[0].closed);
  EXPECT_EQ(report.components[0].genus, std::nullopt);
  EXPECT_EQ(report.components[0].signed_volume, 2);
}

/// The obvious version: maps and sets, straight from the definitions.
struct ObviousCounts {
  std::size_t boundary = 0, non_manifold = 0, inconsistent = 0, unbalanced = 0, fans_too_many = 0, loops = 0,
              components = 0;
  auto operator<=>(const ObviousCounts&) const = default;
};

template <class Node>
std::size_t connected_components(const std::set<Node>& nodes, const std::set<std::pair<Node, Node>>& links) {
  std::map<Node, Node> colour;
  for (const Node& node : nodes) colour[node] = node;
  for (bool changed = true; changed;) {
    changed = false;
    for (const auto& [a, b] : links) {
      const Node low = std::min(colour[a], colour[b]);
      if (colour[a] != low || colour[b] != low) colour[a] = colour[b] = low, changed = true;
    }
  }
  std::set<Node> colours;
  for (const auto& [node, c] : colour) colours.insert(c);
  return colours.size();
}

ObviousCounts obvious_counts(const TriMesh& mesh) {
  std::map<std::pair<Index, Index>, std::vector<std::pair<Index, Index>>> sides;  // edge -> (triangle, from)
  std::map<Index, std::set<Index>> about;                                         // vertex -> triangles
  std::set<Index> triangles;
  for (Index t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    if (a == b || b == c || c == a) continue;
    triangles.insert(t);
    for (const auto& [p, q] : {std::pair{a, b}, {b, c}, {c, a}}) {
      sides[std::minmax(p, q)].emplace_back(t, p);
      about[p].insert(t);
    }
  }
  ObviousCounts counts;
  std::set<std::pair<Index, Index>> rim, neighbours;
  std::set<Index> rim_vertices;
  for (const auto& [edge, on] : sides) {
    if (on.size() == 1) rim.insert(edge), rim_vertices.insert({edge.first, edge.second});
    counts.boundary += on.size() == 1;
    counts.non_manifold += on.size() > 2;
    counts.inconsistent += on.size() == 2 && on[0].second == on[1].second;
    const auto ascending = std::count_if(
        on.begin(), on.end(), [from = edge.first](const auto& side) { return side.second == from; });
    counts.unbalanced += 2 * static_cast<std::size_t>(ascending) != on.size();
    for (const auto& [t, from] : on) neighbours.insert({on[0].first, t});
  }
  counts.loops = connected_components(rim_vertices, rim);
  counts.components = connected_components(triangles, neighbours);
  for (const auto& [v, around] : about) {
    std::set<std::pair<Index, Index>> links;
    for (const auto& [edge, on] : sides) {
      if (edge.first != v && edge.second != v) continue;
      for (const auto& [t, from] : on) links.insert({on[0].first, t});
    }
    counts.fans_too_many += connected_components(around, links) > 1;
  }
  return counts;
}

TEST(Inspect, RandomTangledMeshesAreCountedAsTheDefinitionsSay) {
  std::mt19937 random(7);
  for (int round = 0; round < 300; ++round) {
    const Index vertices = 4 + static_cast<Index>(random() % 12);
    TriMesh mesh;
    for (Index v = 0; v < vertices; ++v)
      mesh.vertices.push_back({double(random() % 5), double(random() % 5), double(random() % 5)});
    const std::size_t triangles = 1 + random() % 30;
    for (std::size_t t = 0; t < triangles; ++t) {
      const auto any = [&] { return static_cast<Index>(random() % vertices); };
      mesh.triangles.push_back({any(), any(), any()});
    }
    const auto report = inspect(mesh);
    const ObviousCounts found{
        report.boundary_edges.count,   report.non_manifold_edges.count,    report.inconsistent_edges.count,
        report.unbalanced_edges.count, report.non_manifold_vertices.count, report.boundary_loops.count,
        report.components.size()};
    ASSERT_EQ(found, obvious_counts(mesh)) << "round " << round;
    EXPECT_EQ(report.is_closed(), Mesh(mesh).is_closed());
  }
}

}  // namespace
}  // namespace condyle
