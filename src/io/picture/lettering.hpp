#pragma once

#include <string>

#include "condyle/mesh.hpp"

namespace condyle::io {

/// Half of how thick strokes are.
inline constexpr double stroke_half_width = 0.055;

/// A line of text as triangles on a plane: x to the right from 0, y up from the base line, digits 1 high. Small letters,
/// digits, the letters of sides (A, P, S, I, R, L), blank and .:,+-<>; anything else is a box. Triangles overlap.
TriMesh lettering(const std::string& text, double half_width = stroke_half_width);

}  // namespace condyle::io
