#pragma once

#include <string>

#include "condyle/mesh.hpp"

namespace condyle::io {

/// A line of text as triangles on a plane: x to the right from 0, y up from the base line, digits 1 high. Small letters,
/// digits, blank and .,+-; anything else is a box. Triangles overlap.
TriMesh lettering(const std::string& text);

}  // namespace condyle::io
