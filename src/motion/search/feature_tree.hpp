#pragma once

#include <array>
#include <vector>

#include "condyle/mesh.hpp"
#include "mesh/edge_table.hpp"
#include "mesh/triangle_tree.hpp"
#include "motion/events/rotation_function.hpp"

namespace condyle::motion {

/// A tree over the triangles, edges and vertices of a mesh. Built once per mesh in its own frame; good for
/// every axis and pose.
///
/// Each vertex and each edge belongs to the first triangle that has it, in tree order:
/// nodes own ranges of all three, and a pair of leaves meets every pair of features exactly once.
///
/// A slot is the number of a triangle, edge or vertex in that order, beside its number in the mesh. Vertices no
/// triangle uses are left out: they are on no surface.
class FeatureTree {
 public:
  using Node = mesh::TriangleTree::Node;

  explicit FeatureTree(const Mesh& mesh);

  /// The same over vertices elsewhere, one for each of the mesh's: as TriangleTree::moved_to.
  FeatureTree moved_to(const Points& mesh_vertices) const;

  struct Range {
    Index first = 0, last = 0;
  };

  const auto& nodes() const noexcept { return base_.nodes(); }
  bool empty() const noexcept { return base_.empty(); }

  /// Its triangles in the same order.
  const mesh::TriangleTree& triangle_tree() const noexcept { return base_; }

  /// Corners and ends are slots of vertices: corners in the mesh's order, ends in ascending order of the
  /// mesh's numbers, so that what is computed from a feature does not depend on the tree.
  std::span<const Triangle> triangles() const noexcept { return base_.triangles(); }
  const std::vector<std::array<Index, 2>>& edges() const noexcept { return edges_; }
  std::span<const Vec3> vertices() const noexcept { return base_.vertices(); }

  /// Features that belong to a triangle.
  Range edges_of(Index triangle) const noexcept {
    return {edges_before_[triangle], edges_before_[triangle + 1]};
  }
  Range vertices_of(Index triangle) const noexcept {
    return {vertices_before_[triangle], vertices_before_[triangle + 1]};
  }

  /// Numbers in the mesh the tree was built from.
  Index mesh_triangle(Index slot) const noexcept { return base_.mesh_triangles()[slot]; }
  Index mesh_vertex(Index slot) const noexcept { return base_.mesh_vertices()[slot]; }

  /// Whether the mesh is closed, and so has an inside.
  bool is_closed() const noexcept { return is_closed_; }
  /// The slot of one vertex of each connected component.
  const std::vector<Index>& component_vertices() const noexcept { return component_vertices_; }

 private:
  void count_vertices();
  void gather_edges(const mesh::EdgeTable& table);

  mesh::TriangleTree base_;
  std::vector<std::array<Index, 2>> edges_;
  std::vector<Index> edges_before_, vertices_before_;  ///< one entry per triangle, plus one
  std::vector<Index> component_vertices_;
  bool is_closed_;
};

/// A ball around the node's box.
struct NodeBall {
  Vec3 centre;
  double radius;
};
NodeBall ball_of(const mesh::TriangleTree::Node& node) noexcept;

}  // namespace condyle::motion
