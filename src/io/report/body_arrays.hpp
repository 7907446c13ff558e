#pragma once

#include <string>
#include <vector>

#include "condyle/mesh.hpp"
#include "io/report/block_arrays.hpp"

namespace condyle::io {

/// x, y and z of each point in turn.
std::vector<double> interleaved(PointsView points);

/// Corners of each triangle in turn.
std::vector<std::uint32_t> corners_of(const Mesh& mesh);

/// ROLE_vertices and ROLE_triangles of a body.
void add_body(BlockArrays& arrays, const std::string& role, const Mesh& mesh);

}  // namespace condyle::io
