#include "condyle/motion/feature_tree.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "condyle/motion/rotation_table.hpp"
#include "support/brute_force.hpp"
#include "support/test_meshes.hpp"

namespace condyle {
namespace {

using namespace test;

TEST(FeatureTree, gives_every_feature_to_exactly_one_leaf) {
  const TriMesh mesh = torus(3, 1, 20, 12);
  const FeatureTree tree(mesh);
  std::vector<int> triangles(tree.triangles().size()), edges(tree.edges().size()),
      vertices(tree.vertices().size());
  const auto count = [](FeatureTree::Range range, std::vector<int>& in) {
    for (Index i = range.first; i < range.last; ++i) ++in[i];
  };
  for (const auto& node : tree.nodes()) {
    if (!node.is_leaf()) continue;
    count(node.triangles, triangles), count(node.edges, edges), count(node.vertices, vertices);
  }
  for (const auto* counts : {&triangles, &edges, &vertices}) {
    EXPECT_EQ(std::count(counts->begin(), counts->end(), 1), static_cast<long>(counts->size()));
  }
  EXPECT_EQ(triangles.size(), mesh.triangles.size());
  EXPECT_EQ(edges.size(), mesh.triangles.size() * 3 / 2);
  EXPECT_EQ(vertices.size(), mesh.vertices.size());
}

TEST(FeatureTree, gives_a_leaf_only_features_of_its_own_triangles) {
  const FeatureTree tree(torus(3, 1, 20, 12));
  for (const auto& node : tree.nodes()) {
    std::set<Index> corners;
    for (Index t = node.triangles.first; t < node.triangles.last; ++t) {
      corners.insert(tree.triangles()[t].begin(), tree.triangles()[t].end());
    }
    for (Index v = node.vertices.first; v < node.vertices.last; ++v) EXPECT_TRUE(corners.count(v));
    for (Index e = node.edges.first; e < node.edges.last; ++e) {
      EXPECT_TRUE(corners.count(tree.edges()[e][0]) && corners.count(tree.edges()[e][1]));
    }
  }
}

TEST(FeatureTree, keeps_every_corner_of_a_node_in_its_ball) {
  const FeatureTree tree(sphere({5, 6, 7}, 2, 3));
  for (const auto& node : tree.nodes()) {
    for (Index t = node.triangles.first; t < node.triangles.last; ++t) {
      for (const Index v : tree.triangles()[t]) {
        const auto d = tree.vertices()[v] - node.centre;
        EXPECT_LE(std::sqrt(dot(d, d)), node.radius);
      }
    }
  }
}

TEST(FeatureTree, remembers_the_numbers_of_the_mesh) {
  const TriMesh mesh = joined(box({0, 0, 0}, {1, 1, 1}), sphere({5, 0, 0}, 1, 1));
  const FeatureTree tree(mesh);
  for (Index t = 0; t < tree.triangles().size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_EQ(tree.mesh_vertex(tree.triangles()[t][k]), mesh.triangles[tree.mesh_triangle(t)][k]);
    }
  }
  for (const auto& [a, b] : tree.edges()) EXPECT_LT(tree.mesh_vertex(a), tree.mesh_vertex(b));
  EXPECT_EQ(tree.pieces().size(), 2u);
}

TEST(FeatureTree, leaves_out_vertices_no_triangle_uses) {
  TriMesh mesh = box({0, 0, 0}, {1, 1, 1});
  mesh.vertices.push_back({9, 9, 9});
  const FeatureTree tree(mesh);
  EXPECT_EQ(tree.vertices().size(), 8u);
  EXPECT_EQ(tree.pieces().size(), 1u);
  EXPECT_TRUE(tree.is_closed());
}

TEST(FeatureTree, knows_an_open_mesh) {
  TriMesh mesh = box({0, 0, 0}, {1, 1, 1});
  mesh.triangles.pop_back();
  EXPECT_FALSE(FeatureTree(mesh).is_closed());
  EXPECT_TRUE(FeatureTree(TriMesh{}).empty());
}

/// Points in general position and in line with vertices and edges along the axis, on it, and level with
/// vertices.
TEST(WindingNumber, through_the_table_equals_brute_force) {
  const TriMesh mesh =
      joined(joined(torus(3, 1, 8, 6), box({-1, -1, -1}, {1, 1, 1})), box({-0.5, -2, -3}, {2, 2, 3}));
  const FeatureTree tree(mesh);
  const AxisFrame axis(Vec3::Zero(), Vec3::UnitZ());
  const RotationTable table(tree, axis);
  TurningBody body(tree);
  body.start_at(axis, Pose::Identity());
  int inside = 0;
  for (double x = -4; x <= 4; x += 0.5) {
    for (double y = -4; y <= 4; y += 0.5) {
      for (double z = -3.25; z <= 3.25; z += 0.5) {
        const auto truth = winding_number(mesh, Vec3(x, y, z));
        if (truth.on_surface) continue;
        EXPECT_EQ(winding_number(table, Triple<double>{x, y, z}), truth.winding);
        EXPECT_EQ(winding_number(body, Triple<double>{x, y, z}), truth.winding);
        inside += truth.winding > 0;
      }
    }
  }
  EXPECT_GT(inside, 300);
}

}  // namespace
}  // namespace condyle
