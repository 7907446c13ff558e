#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "condyle/mesh.hpp"

namespace condyle::mesh {

/// Half-edge 3t + k runs along side k of triangle t, from corner k to corner k + 1.
using HalfEdge = Index;

/// Triangles that hang together over edges, two triangles' or more. Solids that touch in a vertex are two
/// components; a triangle whose three corners are one vertex is a component of its own.
struct ConnectedComponents {
  std::vector<Index> of_triangle;     ///< Number of its component.
  std::vector<Index> first_triangle;  ///< One for each component; ascending.
};

/// The edges of a mesh: every pair of vertices that a triangle's side joins, and the half-edges along it.
///
///   offset_     0     2  2+2      ...      one entry per edge, plus one
///   half_edge_ | h h | h h |      ...      edge e owns [offset_[e], offset_[e+1]), ascending
///
/// Edges are in ascending order of (smaller, larger) vertex. A side from a vertex to itself is no edge; the
/// other two of such a triangle are, and cancel each other.
///
/// Memory: 6 indices per triangle and 3 per edge. Time linear in triangles, but for n log n in the triangles
/// around one vertex.
class EdgeTable {
 public:
  /// Every index in range.
  explicit EdgeTable(const TriMesh& mesh);

  std::size_t size() const noexcept { return ends_.size(); }
  /// Smaller vertex first.
  const std::array<Index, 2>& ends(std::size_t edge) const noexcept { return ends_[edge]; }
  /// Ascending.
  std::span<const HalfEdge> half_edges(std::size_t edge) const noexcept {
    return std::span(half_edge_).subspan(offset_[edge], offset_[edge + 1] - offset_[edge]);
  }
  /// The edge on which a half-edge lies; no_index for a side from a vertex to itself.
  Index edge_of(HalfEdge h) const noexcept { return edge_of_[h]; }

  /// Uses from the smaller to the larger vertex, less those in the opposite direction: 0 if it is balanced.
  int balance(const TriMesh& mesh, std::size_t edge) const noexcept;
  /// The first directed edge, in the order of triangles and within one of vertices, that is used more often
  /// than its opposite; none in a closed mesh.
  std::optional<DirectedEdge> unbalanced_edge(const TriMesh& mesh) const noexcept;
  /// Near linear in triangles.
  ConnectedComponents components() const;

 private:
  std::vector<std::array<Index, 2>> ends_;
  std::vector<Index> offset_;
  std::vector<HalfEdge> half_edge_;
  std::vector<Index> edge_of_;
};

/// The mesh's own table: built when first asked for, by whichever thread, and kept with the mesh.
const EdgeTable& edges_of(const Mesh& mesh);

}  // namespace condyle::mesh
