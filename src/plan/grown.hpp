#pragma once

#include "condyle/mesh.hpp"

namespace condyle::plan {

/// A mesh with its surface moved outwards, mm: each vertex to where the planes of its triangles are, moved so far; in the sense of least
/// squares with the angles that they have there as weights, where there are more than three, and then farther, until it is outside of all.
Mesh grown(const Mesh& mesh, double by_mm);

}  // namespace condyle::plan
