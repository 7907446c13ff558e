#pragma once

#include <functional>

#include "condyle/mesh.hpp"

namespace condyle::mesh {

/// Every triangle cut into four at the midpoints of its edges.
///
///          c             The old vertices keep their numbers; one new vertex per edge follows, in
///         / \            ascending order of the edge's (smaller, larger) vertex. Triangle t becomes
///      ca --- bc         4t .. 4t + 3: the corners at a, b, c, then the middle one. V + E vertices,
///       / \ / \          4 F triangles; edges shared by any number of triangles stay shared. The surface
///      a - ab - b        does not move, up to the rounding of the midpoints.
///
/// Every index in range.
TriMesh subdivided(const TriMesh& mesh);

/// The same, each new vertex moved from the midpoint to place(midpoint). Called from several threads.
TriMesh subdivided(const TriMesh& mesh, const std::function<Vec3(const Vec3&)>& place);

}  // namespace condyle::mesh
