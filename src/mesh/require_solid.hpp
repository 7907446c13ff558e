#pragma once

#include <string>

#include "condyle/mesh.hpp"

namespace condyle::mesh {

/// Raises MeshError where a mesh does not bound a solid, or bounds it inside out, so that nothing could ever
/// be inside it. One line: `name`, which boundary or edge, what can still be computed, which repair helps.
///
/// n log n.
void require_solid(const TriMesh& mesh, const std::string& name);

}  // namespace condyle::mesh
