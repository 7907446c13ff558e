#pragma once

#include <optional>

#include "condyle/mesh.hpp"

namespace condyle::mesh {

/// The first directed edge, in the order of triangles, that is used more often than its opposite, or none. A
/// mesh without one bounds a solid in the sense of the winding number: rays cross it as often inwards as
/// outwards. This asks less than being a closed manifold, and exactly as much as a winding number needs.
///
/// `Mesh` calls this in its constructor: all other code queries the Mesh. Decides as EdgeTable does, without building
/// one for a closed mesh.
///
/// Vertices are fewer than 2^31. Linear in the number of triangles for a closed mesh; n log n otherwise.
std::optional<DirectedEdge> first_unbalanced_edge(const TriMesh& mesh);

/// Raises MeshError naming that edge: without an inside there is no winding number; what can still be
/// computed is said.
[[noreturn]] void refuse_unbalanced(const DirectedEdge& edge);

}  // namespace condyle::mesh
