#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "condyle/mesh.hpp"
#include "core/lazy.hpp"
#include "core/uninitialised.hpp"

namespace condyle::mesh {

/// A tree over the triangles of a mesh, of boxes and of shells about the origin of its frame. Built once per
/// mesh; good for every pose.
///
///   node    0               children of a node: two neighbours, node[i].child and the next
///          / .
///         1   2             triangles are numbered anew ("places") so that every node owns a range of them;
///        / .  ...           vertices too, in the order in which those triangles first use them
///       3   4
///
/// A head and its socket are two shells about the joint centre, which is the origin, and stay so however the
/// joint turns: most of two bones leaves by distance from the centre alone, near the roots.
///
/// Vertices no triangle uses are left out: they are on no surface. Linear in triangles but for a sort by
/// digits.
class TriangleTree {
 public:
  /// One cache line. Single precision, rounded outwards: a node never holds less than its triangles, at worst
  /// (coordinates beyond single precision) everything.
  struct alignas(64) Node {
    std::array<float, 4> centre, half;  ///< The box; the fourth is 0.
    float nearest, farthest;            ///< From the origin, bounds on every point of its triangles.
    Index first, last;                  ///< Places of its triangles.
    Index child;                        ///< 0 for a leaf.

    bool is_leaf() const noexcept { return child == 0; }
    float size() const noexcept { return half[0] + half[1] + half[2]; }
  };

  /// In a leaf, at most. On a hip of 156 000 and 99 000 triangles 4, 6 and 8 take 0.96, 0.90 and 0.87 ms for
  /// all pairs of a pose in contact, 0.44, 0.42 and 0.40 ms for a first contact, and the same for a free
  /// pose.
  static constexpr Index leaf_triangles = 8;

  explicit TriangleTree(const TriMesh& mesh);

  /// The same tree over vertices elsewhere, one for each of the mesh's. Good answers whatever the movement, fast ones
  /// while it is small. Linear.
  TriangleTree moved_to(const Points& mesh_vertices) const;

  /// Moves the tree's own vertices: those of the mesh that are marked, one mark for each; without marks, all. Bounds above the
  /// leaves are those of the single-precision boxes below, a little wider than those of a tree made anew. Linear, and for few
  /// marks little more than reading them.
  void refit(const Points& mesh_vertices, std::span<const char> is_moved = {});
  /// Whether boxes have grown so far beyond those of the tree as it was made that making it anew pays. After refit().
  bool is_worn() const noexcept { return overlap_now_ > most_wear * overlap_made_; }

  bool empty() const noexcept { return triangles_.empty(); }
  const core::UninitialisedVector<Node>& nodes() const noexcept { return nodes_; }
  /// Corners are places of vertices, in the mesh's order.
  std::span<const Triangle> triangles() const noexcept { return triangles_; }
  std::span<const Vec3> vertices() const noexcept { return vertices_; }
  /// Numbers in the mesh the tree was built from.
  const std::vector<Index>& mesh_triangles() const noexcept { return mesh_triangles_; }
  const std::vector<Index>& mesh_vertices() const noexcept { return mesh_vertices_; }

  /// The smallest place of each connected piece. Near linear in triangles when first asked for, and kept.
  const std::vector<Index>& one_vertex_of_each_piece() const;

  std::array<Vec3, 3> corners(Index triangle) const noexcept {
    const auto [a, b, c] = triangles_[triangle];
    return {vertices_[a], vertices_[b], vertices_[c]};
  }

 private:
  /// A tree is worn if the sizes of its boxes, in sizes of its root, have grown by this: a search opens about as many more.
  static constexpr double most_wear = 1.5;

  void number_anew(const TriMesh& mesh);
  /// The sizes of all boxes over that of the root.
  double overlap() const noexcept;

  core::UninitialisedVector<Node> nodes_;
  core::UninitialisedVector<Triangle> triangles_;
  core::UninitialisedVector<Vec3> vertices_;
  std::vector<Index> mesh_triangles_, mesh_vertices_;
  core::Lazy<std::vector<Index>> piece_vertices_;
  double overlap_made_ = 0, overlap_now_ = 0;  ///< from the first refit on
};

/// The mesh's own tree: built when first asked for, by whichever thread, and kept with the mesh.
std::shared_ptr<const TriangleTree> tree_of(const Mesh& mesh);

}  // namespace condyle::mesh
