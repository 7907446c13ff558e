#pragma once

#include "condyle/mesh.hpp"

namespace condyle::mesh {

/// Multiplies every coordinate: by 1 it keeps every bit.
inline void scale(TriMesh& mesh, double factor) {
  for (auto* coordinates : {&mesh.vertices.x, &mesh.vertices.y, &mesh.vertices.z})
    for (double& value : *coordinates) value *= factor;
}

}  // namespace condyle::mesh
