#pragma once

#include "condyle/mesh.hpp"

namespace condyle::kinematics {

/// Corners of all triangles: vertices that no triangle uses, which dirty meshes have anywhere, are no surface.
template <class Visit>
void for_each_corner(const TriMesh& mesh, const Visit& visit) {
  for (const Triangle& triangle : mesh.triangles)
    for (const Index v : triangle) visit(Vec3(mesh.vertices[v]));
}

}  // namespace condyle::kinematics
