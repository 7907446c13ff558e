#pragma once

#include "condyle/mesh.hpp"
#include "sample/field.hpp"

namespace condyle::sample {

/// The surface of a solid, as a closed mesh wound outwards whose vertices lie on the edges of a regular
/// lattice, where the field changes sign (placed linearly, not laid).
///
/// Marching tetrahedra: every lattice cube is cut into the six tetrahedra about its long diagonal, and a
/// tetrahedron has no ambiguous case, so the result is always closed and manifold. Its triangles are badly
/// shaped; they are a start for remeshing. Details thinner than `spacing` may be lost. Raises MeshError if
/// the surface leaves the solid's box.
TriMesh contoured(const Solid& solid, double spacing);

}  // namespace condyle::sample
