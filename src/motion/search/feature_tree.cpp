#include "motion/search/feature_tree.hpp"

#include <algorithm>
#include <cmath>

namespace condyle::motion {

FeatureTree::FeatureTree(const Mesh& mesh) : base_(*mesh::tree_of(mesh)), is_closed_(mesh.is_closed()) {
  count_vertices();
  gather_edges(mesh::edges_of(mesh));
  component_vertices_ = base_.one_vertex_of_each_piece();
}

FeatureTree FeatureTree::moved_to(const Points& mesh_vertices) const {
  FeatureTree moved = *this;
  moved.base_ = base_.moved_to(mesh_vertices);
  return moved;
}

/// The order of vertices is that in which triangles first use them.
void FeatureTree::count_vertices() {
  vertices_before_.reserve(triangles().size() + 1);
  vertices_before_.push_back(0);
  for (const auto& [a, b, c] : triangles())
    vertices_before_.push_back(std::max({vertices_before_.back(), a + 1, b + 1, c + 1}));
}

void FeatureTree::gather_edges(const mesh::EdgeTable& table) {
  std::vector<bool> met(table.size(), false);
  edges_.reserve(table.size());
  edges_before_.reserve(triangles().size() + 1);
  edges_before_.push_back(0);
  for (Index t = 0; t < triangles().size(); ++t) {
    for (Index k = 0; k < 3; ++k) {
      const Index edge = table.edge_of(3 * mesh_triangle(t) + k);
      // A side without length is its vertex.
      if (edge == no_index || met[edge]) continue;
      met[edge] = true;
      const Index from = triangles()[t][k], to = triangles()[t][(k + 1) % 3];
      const bool ascending = mesh_vertex(from) < mesh_vertex(to);
      edges_.push_back({ascending ? from : to, ascending ? to : from});
    }
    edges_before_.push_back(static_cast<Index>(edges_.size()));
  }
}

NodeBall ball_of(const mesh::TriangleTree::Node& node) noexcept {
  const auto square = [](double a) { return a * a; };
  const auto& [x, y, z, none] = node.half;
  // More than the roundings of the sum and of the root.
  constexpr double radius_slack = 1e-12;
  return {{node.centre[0], node.centre[1], node.centre[2]},
          std::sqrt(square(x) + square(y) + square(z)) * (1 + radius_slack)};
}

}  // namespace condyle::motion
