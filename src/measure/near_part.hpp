#pragma once

#include "condyle/fit.hpp"

namespace condyle::measure {

/// The triangles that reach into a ball, over the mesh's vertices that they use. Linear in the mesh.
TriMesh near_part(const TriMesh& mesh, const Sphere& ball);

/// Of these triangles those that face a point: the wall of a socket, seen from the centre of its head.
TriMesh facing_part_of(const TriMesh& mesh, const Vec3& point);

}  // namespace condyle::measure
