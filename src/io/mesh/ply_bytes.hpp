#pragma once

#include <string>

#include "condyle/mesh.hpp"

namespace condyle::io {

/// What write_mesh() puts into a PLY file. The mesh has at most as many vertices as an int can number.
std::string ply_bytes(const TriMesh& mesh);

}  // namespace condyle::io
