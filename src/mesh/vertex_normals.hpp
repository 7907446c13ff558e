#pragma once

#include "condyle/mesh.hpp"

namespace condyle::mesh {

/// For each vertex twice the sum of the area vectors of its triangles: outwards, longer the more surface there is
/// around it; zero if no triangle uses it.
inline Points area_normals(const TriMesh& mesh) {
  Points normals(mesh.vertices.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Vec3 a = mesh.corner(t, 0);
    const Vec3 normal = (mesh.corner(t, 1) - a).cross(mesh.corner(t, 2) - a);
    for (const Index v : mesh.triangles[t]) normals.set(v, normals[v] + normal);
  }
  return normals;
}

}  // namespace condyle::mesh
