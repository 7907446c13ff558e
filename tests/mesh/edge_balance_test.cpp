#include "condyle/mesh/edge_balance.hpp"

#include <gtest/gtest.h>

#include "support/test_meshes.hpp"

namespace condyle {
namespace {

TEST(EdgeBalance, ClosedMeshesHaveNoUnbalancedEdge) {
  EXPECT_FALSE(unbalanced_edge(test::box({0, 0, 0}, {1, 1, 1})));
  EXPECT_FALSE(unbalanced_edge(test::socket({0, 0, 0}, 1, 2, 2)));
  EXPECT_FALSE(unbalanced_edge(test::flipped(test::torus(2, 1, 5, 5))));
}

TEST(EdgeBalance, TheFirstBoundaryEdgeIsNamedInItsDirection) {
  TriMesh mesh = test::box({0, 0, 0}, {1, 1, 1});
  const Triangle removed = mesh.triangles.back();  // {3, 7, 5}
  mesh.triangles.pop_back();
  const auto edge = unbalanced_edge(mesh);
  ASSERT_TRUE(edge);
  // What is left uses each edge of the hole once, against the direction of the triangle that is gone.
  const auto has = [&](Index from, Index to) {
    for (int k = 0; k < 3; ++k) {
      if (removed[k] == from && removed[(k + 1) % 3] == to) return true;
    }
    return false;
  };
  EXPECT_TRUE(has(edge->second, edge->first));
}

TEST(EdgeBalance, AFlippedTriangleIsUnbalanced) {
  TriMesh mesh = test::box({0, 0, 0}, {1, 1, 1});
  std::swap(mesh.triangles[4][0], mesh.triangles[4][1]);
  EXPECT_TRUE(unbalanced_edge(mesh));
}

TEST(EdgeBalance, AnEdgeOfFourTrianglesMayBalance) {
  // Two boxes that share an edge: not a manifold, yet a solid.
  TriMesh two = test::joined(test::box({0, 0, 0}, {1, 1, 1}), test::box({1, 1, 0}, {2, 2, 1}));
  for (auto& triangle : two.triangles) {
    for (auto& v : triangle) {
      if (v == 8) v = 3;
      if (v == 12) v = 7;
    }
  }
  EXPECT_FALSE(unbalanced_edge(two));
}

}  // namespace
}  // namespace condyle
