#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "condyle/mesh.hpp"

namespace condyle::mesh {

/// An edge with its two triangles' third corners. Triangle (a, b, left) lies to the left of a -> b seen from
/// outside, (b, a, right) to the right.
struct EdgeStar {
  Index a, b, left, right;
};

/// A closed manifold triangle mesh that can be edited in place. Every edit keeps it closed, manifold,
/// consistently wound, and of the same genus: edits that would not are refused by `can_collapse` and
/// `can_flip`. Removed vertices and triangles leave gaps until `packed`.
class EditableMesh {
 public:
  /// The mesh must be closed and manifold.
  explicit EditableMesh(const TriMesh& mesh);

  std::size_t vertex_count() const noexcept { return vertex_count_; }
  /// One past the largest vertex number ever used; some numbers below it may be gone.
  Index vertex_end() const noexcept { return static_cast<Index>(position_.size()); }
  bool has_vertex(Index v) const noexcept { return !around_[v].empty(); }

  const Vec3& position(Index v) const noexcept { return position_[v]; }
  void move(Index v, const Vec3& p) noexcept { position_[v] = p; }
  bool has_triangle(Index t) const noexcept { return triangle_[t][0] != no_index; }
  const Triangle& triangle(Index t) const noexcept { return triangle_[t]; }
  /// Triangles at a vertex, in no geometric order.
  const std::vector<Index>& around(Index v) const noexcept { return around_[v]; }

  /// Vertices joined to v by an edge, ascending.
  std::vector<Index> neighbours(Index v) const;
  /// All edges as (smaller, larger) vertex, ascending.
  std::vector<std::pair<Index, Index>> edges() const;
  /// Empty when a and b are not joined by an edge.
  std::optional<EdgeStar> star(Index a, Index b) const noexcept;

  /// Link condition: contracting the edge keeps the surface a manifold of the same genus exactly when the
  /// only vertices joined to both ends are the two opposite corners, and neither of these has only three
  /// triangles.
  bool can_collapse(const EdgeStar& edge) const;
  /// b is merged into a, which moves to p. One vertex and two triangles less.
  void collapse(const EdgeStar& edge, const Vec3& p);

  /// Whether left and right are not joined yet, and both ends keep at least three triangles.
  bool can_flip(const EdgeStar& edge) const noexcept;
  /// The edge a b becomes the edge left right.
  void flip(const EdgeStar& edge);

  /// A new vertex at p on the edge. One vertex and two triangles more. Returns its number.
  Index split(const EdgeStar& edge, const Vec3& p);

  /// The mesh without gaps, remaining vertices and triangles in their order.
  TriMesh packed() const;

 private:
  void replace_corner(Index t, Index from, Index to) noexcept;
  void detach(Index v, Index t) noexcept;
  Index triangle_with(Index a, Index b) const noexcept;
  /// The corner after v of a triangle at v.
  Index next_around(Index t, Index v) const noexcept;

  std::vector<Vec3> position_;
  std::vector<Triangle> triangle_;  ///< removed ones start with no_index
  std::vector<std::vector<Index>> around_;
  std::size_t vertex_count_ = 0;
};

}  // namespace condyle::mesh
