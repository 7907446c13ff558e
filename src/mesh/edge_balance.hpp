#pragma once

#include <optional>
#include <utility>

#include "condyle/mesh.hpp"

namespace condyle::mesh {

/// The first directed edge (from, to), in the order of triangles, that is used more often in one direction
/// than in the other, or none. A mesh without one bounds a solid in the sense of the winding number: rays
/// cross it as often inwards as outwards. This asks less than being a closed manifold, and exactly as much as
/// a winding number needs.
///
/// Linear in the number of triangles for a closed mesh; n log n otherwise.
std::optional<std::pair<Index, Index>> unbalanced_edge(const TriMesh& mesh);

/// Raises MeshError naming that edge: without an inside there is no winding number; what can still be
/// computed is said.
[[noreturn]] void refuse_unbalanced(const std::pair<Index, Index>& edge);
[[noreturn]] void refuse_unbalanced(const DirectedEdge& edge);

}  // namespace condyle::mesh
