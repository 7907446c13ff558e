#pragma once

#include <span>
#include <vector>

#include "condyle/mesh.hpp"

namespace condyle::mesh {

/// Which triangles have each vertex as a corner.
///
///   first      0     3     5  ...      one entry per vertex, plus one
///   triangle  | a b c | b d | ...      vertex i owns [first[i], first[i + 1]), in ascending order
class VertexTriangles {
 public:
  VertexTriangles() = default;
  /// Linear. Vertices and triangles of the mesh may move afterwards, not change.
  explicit VertexTriangles(const TriMesh& mesh) : VertexTriangles(mesh.triangles, mesh.vertices.size()) {}
  /// The same for triangles without a mesh: their numbers are their places in `triangles`.
  VertexTriangles(std::span<const Triangle> triangles, std::size_t vertices);

  bool empty() const noexcept { return first_.empty(); }
  std::span<const Index> of(Index vertex) const noexcept {
    return {triangle_.data() + first_[vertex], triangle_.data() + first_[vertex + 1]};
  }
  /// The triangles of several vertices, each once, in ascending order. Linear in its result, and a test of a bit
  /// for each triangle of the mesh.
  std::vector<Index> of(std::span<const Index> vertices) const;

  std::size_t bytes() const noexcept { return (first_.size() + triangle_.size()) * sizeof(Index); }

 private:
  std::vector<Index> first_, triangle_;
};

/// The mesh's own: built when first asked for, by whichever thread, and kept with the mesh and all that are moved from it.
const VertexTriangles& triangles_at_vertices_of(const Mesh& mesh);

}  // namespace condyle::mesh
