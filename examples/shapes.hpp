#pragma once

#include "condyle/mesh.hpp"

/// Meshes for the examples: a ball, a flat sheet, and a block with a spherical socket in it.

namespace examples {

/// Closed sphere about the origin, mm, of so many circles of latitude between its poles, which are on the y axis.
condyle::TriMesh ball(double radius, condyle::Index rings = 31);

/// A square of side 2 `half` about the origin at y = 0, normal +y, in n x n squares cut in two: an open sheet.
condyle::TriMesh sheet(double half, condyle::Index n);

/// A sphere of twice the radius with a spherical cavity about the origin, mm: closed, two skins.
condyle::TriMesh socket(double radius);

}  // namespace examples
