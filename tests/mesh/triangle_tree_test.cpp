#include "mesh/triangle_tree.hpp"

#include "support/test.hpp"

namespace condyle {
namespace {

using Node = mesh::TriangleTree::Node;

TEST(TriangleTree, GivesEveryTriangleToOneLeafAndItsRangesToItsChildren) {
  const TriMesh mesh = test::torus(3, 1, 20, 12);
  const mesh::TriangleTree tree(mesh);
  std::vector<int> owners(mesh.triangles.size());
  for (const Node& node : tree.nodes()) {
    if (node.is_leaf()) {
      EXPECT_LE(node.last - node.first, mesh::TriangleTree::leaf_triangles);
      for (Index t = node.first; t < node.last; ++t) ++owners[t];
    } else {
      const Node &left = tree.nodes()[node.child], &right = tree.nodes()[node.child + 1];
      EXPECT_EQ(left.first, node.first);
      EXPECT_EQ(left.last, right.first);
      EXPECT_EQ(right.last, node.last);
    }
  }
  EXPECT_EQ(std::count(owners.begin(), owners.end(), 1), static_cast<long>(owners.size()));
}

TEST(TriangleTree, RemembersTheNumbersOfTheMesh) {
  TriMesh mesh = test::joined(test::box({0, 0, 0}, {1, 1, 1}), test::sphere({5, 0, 0}, 1, 2));
  mesh.vertices.push_back({9, 9, 9});  // of no triangle
  const mesh::TriangleTree tree(mesh);
  EXPECT_EQ(tree.vertices().size(), mesh.vertices.size() - 1);
  std::vector<Index> seen;
  for (Index t = 0; t < tree.triangles().size(); ++t) {
    seen.push_back(tree.mesh_triangles()[t]);
    for (int k = 0; k < 3; ++k) {
      EXPECT_EQ(tree.corners(t)[static_cast<std::size_t>(k)], mesh.corner(seen.back(), k));
      EXPECT_EQ(tree.mesh_vertices()[tree.triangles()[t][k]], mesh.triangles[seen.back()][k]);
    }
  }
  std::sort(seen.begin(), seen.end());
  for (Index t = 0; t < seen.size(); ++t) EXPECT_EQ(seen[t], t);
}

/// A box about the origin, where the nearest points of most faces are inside them; meshes beside the origin;
/// and one that single precision does not resolve.
TEST(TriangleTree, HoldsEveryPointOfANodeInItsBoxAndItsShell) {
  for (const TriMesh& mesh : {test::box({-1, -2, -1.5}, {1, 2, 3}), test::sphere({5, 6, 7}, 2, 3),
                              test::torus(3, 1, 20, 12), test::sphere({1e7, 3e7, 0}, 2, 2)}) {
    const mesh::TriangleTree tree(mesh);
    for (const Node& node : tree.nodes()) {
      for (Index t = node.first; t < node.last; ++t) {
        const auto [a, b, c] = tree.corners(t);
        for (const Vec3& p : {a, b, c}) {
          for (int axis = 0; axis < 3; ++axis) {
            const auto k = static_cast<std::size_t>(axis);
            EXPECT_LE(std::abs(p[axis] - double{node.centre[k]}), node.half[k]);
          }
        }
        for (int i = 0; i <= 8; ++i) {
          for (int j = 0; i + j <= 8; ++j) {
            const double r = ((i * a + j * b + (8 - i - j) * c) / 8).norm();
            EXPECT_LE(node.nearest, r * (1 + 1e-15));
            EXPECT_GE(node.farthest, r * (1 - 1e-15));
          }
        }
      }
    }
  }
}

/// The nearest point of a triangle with corners at distance R and edges no longer than e is no nearer than
/// sqrt(R^2 - e^2 / 3), its circumcentre at the worst; single precision adds 2^-22 of it.
TEST(TriangleTree, HasATightShellForABallAboutTheOrigin) {
  const TriMesh ball = test::sphere({0, 0, 0}, 2, 3);
  double longest2 = 0;
  for (std::size_t t = 0; t < ball.triangles.size(); ++t)
    for (int k = 0; k < 3; ++k)
      longest2 = std::max(longest2, (ball.corner(t, k) - ball.corner(t, (k + 1) % 3)).squaredNorm());
  const mesh::TriangleTree tree(ball);
  EXPECT_GE(tree.nodes()[0].nearest, std::sqrt(4 - longest2 / 3) * (1 - 0x1p-22));
  EXPECT_LE(tree.nodes()[0].farthest, 2 * (1 + 0x1p-22));
}

TEST(TriangleTree, SplitsTrianglesThatLieInOnePlace) {
  TriMesh mesh = test::box({0, 0, 0}, {1, 1, 1});
  const auto one = mesh.triangles[0];
  mesh.triangles.assign(100, one);
  const mesh::TriangleTree tree(mesh);
  for (const Node& node : tree.nodes())
    EXPECT_TRUE(!node.is_leaf() || node.last - node.first <= mesh::TriangleTree::leaf_triangles);
  EXPECT_TRUE(mesh::TriangleTree(TriMesh{}).empty());
}

}  // namespace
}  // namespace condyle
