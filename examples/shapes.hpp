#pragma once

#include "condyle/mesh.hpp"

/// Meshes for the examples: a ball, and a block with a spherical socket in it.

namespace examples {

/// Closed sphere about the origin, mm.
condyle::TriMesh ball(double radius);

/// A sphere of twice the radius with a spherical cavity about the origin, mm: closed, two skins.
condyle::TriMesh socket(double radius);

}  // namespace examples
