#pragma once

#include <array>
#include <vector>

#include "condyle/mesh.hpp"

namespace bench {

/// A solid filled with tetrahedra. The first vertices are those of the surface mesh, in its order.
struct TetMesh {
  condyle::Points vertices;
  std::vector<std::array<condyle::Index, 4>> tetrahedra;

  double mean_edge_mm() const;
  std::size_t bytes() const noexcept {
    return 3 * vertices.size() * sizeof(double) + tetrahedra.size() * sizeof(tetrahedra[0]);
  }
};

/// Fills a closed mesh with tetrahedra about as large as its triangles at the surface and growing inwards:
/// the Delaunay tetrahedra (CGAL 5.5) of its vertices and of lattice points inside, those whose centroid is
/// inside. No vertex is added on the surface; where a triangle of it is not Delaunay the filled solid differs
/// from the meshed one, by part of a tetrahedron.
TetMesh filled(const condyle::TriMesh& mesh);

}  // namespace bench
