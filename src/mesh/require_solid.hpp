#pragma once

#include <string>

#include "condyle/mesh.hpp"

namespace condyle::mesh {

/// Raises MeshError if a mesh does not bound a solid, or is inverted, so that nothing could ever be inside
/// it. One line: `name`, which boundary or edge, what can still be computed, which repair helps.
///
/// Linear for a solid; n log n where it refuses an open mesh.
void require_solid(const Mesh& mesh, const std::string& name);

/// Raises MeshError if normals do not say which side of a surface is outside: where triangles are wound against each other,
/// and where a closed mesh is inverted. Open meshes pass. As require_solid() otherwise; n log n for an open mesh.
void require_oriented(const Mesh& mesh, const std::string& name);

}  // namespace condyle::mesh
