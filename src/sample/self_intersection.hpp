#pragma once

#include <optional>
#include <utility>

#include "condyle/mesh.hpp"

namespace condyle::sample {

/// The first pair of triangles, ordered by (smaller, larger) number, that meet elsewhere than in the corners
/// and edges they share; empty for a mesh without self-intersections. Exact for the given coordinates.
///
/// Candidates come from a sweep along the mesh's longest side. Triangles without area are not expected.
std::optional<std::pair<Index, Index>> first_self_intersection(const TriMesh& mesh);

}  // namespace condyle::sample
