#pragma once

#include <span>
#include <vector>

#include "condyle/mesh.hpp"

namespace condyle::plan {

/// Unit vectors against the normals of these vertices, each the mean of its own and those of its neighbours in these triangles, `means` times over.
/// One for each vertex of the mesh; zero at the others. Raw normals would cross where triangles are smaller than a cut is deep.
std::vector<Vec3> inward_directions(const TriMesh& mesh, std::span<const Index> vertices,
                                    std::span<const Index> triangles, int means);

}  // namespace condyle::plan
