#include "mesh/edge_table.hpp"

#include <thread>

#include "support/test.hpp"

namespace condyle {
namespace {

using Ends = std::array<Index, 2>;

/// Half-edges by edge, the obvious way.
std::map<Ends, std::vector<mesh::HalfEdge>> edges_by_map(const TriMesh& mesh) {
  std::map<Ends, std::vector<mesh::HalfEdge>> edges;
  for (Index t = 0; t < mesh.triangles.size(); ++t) {
    for (Index k = 0; k < 3; ++k) {
      const Index a = mesh.triangles[t][k], b = mesh.triangles[t][(k + 1) % 3];
      if (a != b) edges[{std::min(a, b), std::max(a, b)}].push_back(3 * t + k);
    }
  }
  return edges;
}

void expect_as_by_map(const TriMesh& mesh) {
  const mesh::EdgeTable table(mesh);
  const auto expected = edges_by_map(mesh);
  ASSERT_EQ(table.size(), expected.size());
  std::vector<Index> edge_of(3 * mesh.triangles.size(), no_index);
  Index edge = 0;
  for (const auto& [ends, half_edges] : expected) {
    EXPECT_EQ(table.ends(edge), ends);
    EXPECT_TRUE(std::ranges::equal(table.half_edges(edge), half_edges));
    for (const auto h : half_edges) edge_of[h] = edge;
    ++edge;
  }
  for (Index h = 0; h < edge_of.size(); ++h) EXPECT_EQ(table.edge_of(h), edge_of[h]);
}

TEST(EdgeTable, HasEveryEdgeOnceWithAllItsHalfEdges) {
  expect_as_by_map({});
  expect_as_by_map(test::box({0, 0, 0}, {1, 1, 1}));
  expect_as_by_map(test::torus(2, 1, 24, 16));
  std::mt19937 random(3);
  for (int i = 0; i < 200; ++i) {
    TriMesh mesh;
    mesh.vertices = Points(8);
    mesh.triangles.resize(random() % 40);
    for (Triangle& t : mesh.triangles)
      for (Index& v : t) v = static_cast<Index>(random() % 8);
    expect_as_by_map(mesh);
  }
}

TEST(EdgeTable, ABalanceIsUsesUpwardsLessUsesDownwards) {
  TriMesh mesh;
  mesh.vertices = Points(5);
  mesh.triangles = {{0, 1, 2}, {0, 1, 3}, {1, 0, 4}};
  const mesh::EdgeTable table(mesh);
  EXPECT_EQ(table.balance(mesh, table.edge_of(0)), 1);   // 0-1: twice up, once down
  EXPECT_EQ(table.balance(mesh, table.edge_of(2)), -1);  // 2-0: once down
}

TEST(EdgeTable, SolidsThatTouchInAVertexAreTwoComponents) {
  TriMesh mesh = test::joined(test::box({0, 0, 0}, {1, 1, 1}), test::box({1, 1, 1}, {2, 2, 2}));
  for (Triangle& t : mesh.triangles) std::replace(t.begin(), t.end(), Index{8}, Index{7});
  const auto components = mesh::EdgeTable(mesh).components();
  EXPECT_EQ(components.first_triangle, (std::vector<Index>{0, 12}));
  for (Index t = 0; t < mesh.triangles.size(); ++t) EXPECT_EQ(components.of_triangle[t], t / 12);
}

TEST(EdgeTable, ComponentsAreNumberedByTheirFirstTriangles) {
  TriMesh mesh = test::joined(test::box({0, 0, 0}, {1, 1, 1}), test::sphere({5, 0, 0}, 1, 1));
  std::reverse(mesh.triangles.begin(), mesh.triangles.end());
  mesh.triangles.insert(mesh.triangles.begin(), {3, 3, 3});
  const auto components = mesh::EdgeTable(mesh).components();
  EXPECT_EQ(components.first_triangle,
            (std::vector<Index>{0, 1, static_cast<Index>(mesh.triangles.size()) - 12}));
}

TEST(EdgeTable, OfAMeshIsBuiltOnceWhoeverAsksFirst) {
  const Mesh mesh = test::torus(2, 1, 60, 40), copy = mesh;
  std::vector<const mesh::EdgeTable*> seen(8);
  std::vector<std::thread> threads;
  for (auto& table : seen) threads.emplace_back([&] { table = &mesh::edges_of(mesh); });
  for (auto& thread : threads) thread.join();
  for (const auto* table : seen) EXPECT_EQ(table, &mesh::edges_of(copy));
  EXPECT_EQ(mesh::edges_of(mesh).size(), mesh.triangles().size() / 2 * 3);
}

}  // namespace
}  // namespace condyle
