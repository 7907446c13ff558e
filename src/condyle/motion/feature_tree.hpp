#pragma once

#include <array>
#include <vector>

#include "condyle/mesh/tri_mesh.hpp"
#include "condyle/motion/cylinder_box.hpp"

namespace condyle {

/// A tree of balls over the triangles of a mesh, each vertex and each edge belonging to one leaf. Built once
/// per mesh in its own frame; good for every axis and pose.
///
///   node    0               children of node i: i + 1 and node[i].right
///          / .
///         1   4             leaves own ranges of triangle, edge and vertex numbers ("places"), so that
///        / .  ...           a pair of leaves meets every pair of features exactly once
///       2   3
///
/// Vertices no triangle uses are left out: they are on no surface.
class FeatureTree {
 public:
  explicit FeatureTree(const TriMesh& mesh);

  struct Range {
    Index first = 0, last = 0;
  };
  struct Node {
    Range triangles, edges, vertices;
    Index right = 0;  ///< 0 for a leaf.
    Triple<double> centre{0, 0, 0};
    double radius = 0;  ///< Of the ball about all corners of the node's triangles.
    /// From the origin of the mesh's frame. A head and its socket are two shells about the joint centre,
    /// which is that origin, and stay so however the joint turns.
    DistanceRange from_origin{0, 0};

    bool is_leaf() const noexcept { return right == 0; }
  };

  const std::vector<Node>& nodes() const noexcept { return nodes_; }
  bool empty() const noexcept { return triangles_.empty(); }

  /// Corners and ends are places of vertices: corners in the mesh's order, ends in ascending order of the
  /// mesh's numbers, so that what is computed from a feature does not depend on the tree.
  const std::vector<Triangle>& triangles() const noexcept { return triangles_; }
  const std::vector<std::array<Index, 2>>& edges() const noexcept { return edges_; }
  const std::vector<Triple<double>>& vertices() const noexcept { return vertices_; }

  /// Numbers in the mesh the tree was built from.
  Index mesh_triangle(Index place) const noexcept { return mesh_triangle_[place]; }
  Index mesh_vertex(Index place) const noexcept { return mesh_vertex_[place]; }

  /// Whether the mesh bounds a solid: every edge is used as often in one direction as in the other.
  bool is_closed() const noexcept { return is_closed_; }
  /// The place of one vertex of each connected piece.
  const std::vector<Index>& pieces() const noexcept { return pieces_; }

 private:
  void set_distances();

  std::vector<Node> nodes_;
  std::vector<Triangle> triangles_;
  std::vector<std::array<Index, 2>> edges_;
  std::vector<Triple<double>> vertices_;
  std::vector<Index> mesh_triangle_, mesh_vertex_;
  std::vector<Index> pieces_;
  bool is_closed_ = false;
};

}  // namespace condyle
