#include "motion/search/feature_tree.hpp"

#include "motion/search/rotation_table.hpp"
#include "support/brute_force.hpp"
#include "support/test.hpp"

namespace condyle::motion {
namespace {

using namespace test;

TEST(FeatureTree, GivesEveryEdgeAndVertexToExactlyOneOfItsTriangles) {
  const TriMesh mesh = torus(3, 1, 20, 12);
  const FeatureTree tree(mesh);
  std::set<std::array<Index, 2>> edges;
  std::vector<int> vertices(tree.vertices().size());
  for (Index t = 0; t < tree.triangles().size(); ++t) {
    const auto& corners = tree.triangles()[t];
    const auto is_corner = [&](Index v) {
      return std::find(corners.begin(), corners.end(), v) != corners.end();
    };
    for (Index v = tree.vertices_of(t).first; v < tree.vertices_of(t).last; ++v) {
      EXPECT_TRUE(is_corner(v));
      ++vertices[v];
    }
    for (Index e = tree.edges_of(t).first; e < tree.edges_of(t).last; ++e) {
      const auto [a, b] = tree.edges()[e];
      EXPECT_TRUE(is_corner(a) && is_corner(b));
      EXPECT_TRUE(edges.insert({std::min(a, b), std::max(a, b)}).second);
    }
  }
  EXPECT_EQ(std::count(vertices.begin(), vertices.end(), 1), static_cast<long>(mesh.vertices.size()));
  EXPECT_EQ(edges.size(), mesh.triangles.size() * 3 / 2);
  EXPECT_EQ(tree.edges().size(), edges.size());
}

TEST(FeatureTree, HasEveryCornerOfANodeInItsBall) {
  const FeatureTree tree(sphere({5, 6, 7}, 2, 3));
  for (const auto& node : tree.nodes()) {
    const NodeBall ball = motion::ball_of(node);
    for (Index t = node.first; t < node.last; ++t) {
      for (const Index v : tree.triangles()[t])
        EXPECT_LE((tree.vertices()[v] - ball.centre).norm(), ball.radius);
    }
  }
}

TEST(RotatingBody, HasNodeBoxesAroundItsVerticesAboutAnyAxis) {
  const TriMesh mesh = sphere({0, 0, 0}, 2, 3);
  const FeatureTree tree(mesh);
  RotatingBody body(tree);
  for (const Vec3& axis_point : {Vec3(0, 0, 0), Vec3(0.3, -0.2, 0.1), Vec3(40, 5, -7)}) {
    for (const Vec3& shift : {Vec3(0, 0, 0), Vec3(0.5, 0.25, -1), Vec3(40, 5, -7)}) {
      Pose X_RT = Pose::Identity();
      X_RT.linear() = Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix();
      X_RT.translation() = shift;
      body.start_at(AxisFrame(axis_point, {1, -2, 0.5}), X_RT);
      for (Index i = 0; i < tree.nodes().size(); ++i) {
        const CylinderBox node_box = body.node_box(i);
        const auto& node = tree.nodes()[i];
        for (Index t = node.first; t < node.last; ++t) {
          for (const Index v : tree.triangles()[t]) {
            const auto p = body.placed_vertex(v);
            const CylinderBox point = motion::box_of_vertex(p, motion::cylinder_point(p));
            EXPECT_TRUE(node_box.overlaps_profile(point) && motion::arcs_meet(node_box, point));
          }
        }
      }
    }
  }
}

TEST(FeatureTree, RemembersTheNumbersOfTheMesh) {
  const TriMesh mesh = joined(box({0, 0, 0}, {1, 1, 1}), sphere({5, 0, 0}, 1, 1));
  const FeatureTree tree(mesh);
  for (Index t = 0; t < tree.triangles().size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_EQ(tree.mesh_vertex(tree.triangles()[t][k]), mesh.triangles[tree.mesh_triangle(t)][k]);
    }
  }
  for (const auto& [a, b] : tree.edges()) EXPECT_LT(tree.mesh_vertex(a), tree.mesh_vertex(b));
  EXPECT_EQ(tree.component_vertices().size(), 2u);
}

TEST(FeatureTree, LeavesOutVerticesNoTriangleUses) {
  TriMesh mesh = box({0, 0, 0}, {1, 1, 1});
  mesh.vertices.push_back({9, 9, 9});
  const FeatureTree tree(mesh);
  EXPECT_EQ(tree.vertices().size(), 8u);
  EXPECT_EQ(tree.component_vertices().size(), 1u);
  EXPECT_TRUE(tree.is_closed());
}

TEST(FeatureTree, KnowsAnOpenMesh) {
  TriMesh mesh = box({0, 0, 0}, {1, 1, 1});
  mesh.triangles.pop_back();
  EXPECT_FALSE(FeatureTree(mesh).is_closed());
  EXPECT_TRUE(FeatureTree(TriMesh{}).empty());
}

/// Points in general position and in line with vertices and edges along the axis, on it, and level with
/// vertices.
TEST(WindingNumber, ThroughTheTableEqualsBruteForce) {
  const TriMesh mesh =
      joined(joined(torus(3, 1, 8, 6), box({-1, -1, -1}, {1, 1, 1})), box({-0.5, -2, -3}, {2, 2, 3}));
  const FeatureTree tree(mesh);
  const AxisFrame axis(Vec3::Zero(), Vec3::UnitZ());
  const RotationTable table(tree, axis);
  RotatingBody body(tree);
  body.start_at(axis, Pose::Identity());
  int inside = 0;
  for (double x = -4; x <= 4; x += 0.5) {
    for (double y = -4; y <= 4; y += 0.5) {
      for (double z = -3.25; z <= 3.25; z += 0.5) {
        const auto truth = test::winding_number(mesh, Vec3(x, y, z));
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
}  // namespace condyle::motion
