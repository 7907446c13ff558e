#pragma once

#include <string>

#include "condyle/mesh.hpp"

namespace condyle {

/// Throws MeshError if a mesh has no triangle with an area: such a triangle meets nothing, as its points belong to its neighbours, and a body
/// of no other would be apart from all. `body` is what the error calls it.
void require_surface(const Mesh& mesh, const std::string& body);

}  // namespace condyle
