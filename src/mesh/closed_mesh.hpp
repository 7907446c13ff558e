#pragma once

#include <cassert>

#include "mesh/edge_balance.hpp"

namespace condyle::mesh {

/// A mesh known to have an inside: checked once, then passed on without checking again. Borrows the mesh.
class ClosedMesh {
 public:
  /// Raises MeshError, naming an edge, where the mesh is not closed.
  explicit ClosedMesh(const TriMesh& mesh) : mesh_(&mesh) {
    if (const auto edge = unbalanced_edge(mesh)) refuse_unbalanced(*edge);
  }
  /// Of a mesh that the caller knows to be closed.
  static ClosedMesh known(const TriMesh& mesh) noexcept {
    assert(!unbalanced_edge(mesh));
    return ClosedMesh(&mesh);
  }

  const TriMesh& mesh() const noexcept { return *mesh_; }

 private:
  explicit ClosedMesh(const TriMesh* mesh) noexcept : mesh_(mesh) {}
  const TriMesh* mesh_;
};

}  // namespace condyle::mesh
