#pragma once

#include <vector>

#include "condyle/fit.hpp"

namespace condyle::measure {

/// Some triangles of a mesh, over the vertices that they use.
struct MeshPart {
  TriMesh mesh;
  std::vector<Index> vertices;  ///< of the whole mesh
};

/// The triangles that reach into a ball. Linear in the mesh.
MeshPart near_part(const TriMesh& mesh, const Sphere& ball);

/// The triangles that face the ball's centre, and those that face away from it.
MeshPart facing_part(const TriMesh& mesh, const Sphere& ball);
MeshPart averted_part(const TriMesh& mesh, const Sphere& ball);

}  // namespace condyle::measure
