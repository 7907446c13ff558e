#include "condyle/motion/feature_tree.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
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

/// A box about the origin, where the nearest points of most faces are inside them, and a ball, where they are
/// corners or nearly so.
TEST(FeatureTree, keeps_every_point_of_a_node_between_its_distances_from_the_origin) {
  for (const TriMesh& mesh : {box({-1, -2, -1.5}, {1, 2, 3}), sphere({0, 0, 0}, 2, 3), torus(3, 1, 20, 12)}) {
    const FeatureTree tree(mesh);
    for (const auto& node : tree.nodes()) {
      for (Index t = node.triangles.first; t < node.triangles.last; ++t) {
        const auto corner = [&](int k) { return tree.vertices()[tree.triangles()[t][k]]; };
        for (int i = 0; i <= 12; ++i) {
          for (int j = 0; i + j <= 12; ++j) {
            const auto along = [&](double Triple<double>::*x) {
              return (i * corner(0).*x + j * corner(1).*x + (12 - i - j) * corner(2).*x) / 12;
            };
            const Vec3 p(along(&Triple<double>::x), along(&Triple<double>::y), along(&Triple<double>::z));
            // The point and its distance are rounded by some 2^-50 of its size.
            EXPECT_LE(node.from_origin.lo, p.norm() * (1 + 1e-15));
            EXPECT_GE(node.from_origin.hi, p.norm() * (1 - 1e-15));
          }
        }
      }
    }
  }
}

/// The nearest point of a triangle with corners at distance R and edges no longer than e is no nearer than
/// sqrt(R^2 - e^2 / 3), its circumcentre at the worst.
TEST(FeatureTree, has_tight_distances_for_a_ball_about_the_origin) {
  const TriMesh ball = sphere({0, 0, 0}, 2, 3);
  double longest2 = 0;
  for (std::size_t t = 0; t < ball.triangles.size(); ++t)
    for (int k = 0; k < 3; ++k)
      longest2 = std::max(longest2, (ball.corner(t, k) - ball.corner(t, (k + 1) % 3)).squaredNorm());
  const DistanceRange range = FeatureTree(ball).nodes()[0].from_origin;
  EXPECT_GE(range.lo, std::sqrt(4 - longest2 / 3) - 1e-12);
  EXPECT_LE(range.hi, 2 + 1e-12);
}

TEST(TurningBody, has_node_boxes_around_its_vertices_about_any_axis) {
  const TriMesh mesh = sphere({0, 0, 0}, 2, 3);
  const FeatureTree tree(mesh);
  TurningBody body(tree);
  for (const Vec3& axis_point : {Vec3(0, 0, 0), Vec3(0.3, -0.2, 0.1), Vec3(40, 5, -7)}) {
    for (const Vec3& shift : {Vec3(0, 0, 0), Vec3(0.5, 0.25, -1), Vec3(40, 5, -7)}) {
      Pose X_RT = Pose::Identity();
      X_RT.linear() = Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix();
      X_RT.translation() = shift;
      body.start_at(AxisFrame(axis_point, {1, -2, 0.5}), X_RT);
      for (Index i = 0; i < tree.nodes().size(); ++i) {
        const CylinderBox node_box = body.node_box(i);
        const auto& node = tree.nodes()[i];
        for (Index t = node.triangles.first; t < node.triangles.last; ++t) {
          for (const Index v : tree.triangles()[t]) {
            const auto p = body.placed_vertex(v);
            const CylinderBox point = box_of_vertex(p, cylinder_point(p));
            EXPECT_TRUE(node_box.shares_profile(point) && arcs_meet(node_box, point));
          }
        }
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
