#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "condyle/mesh.hpp"

namespace condyle::mesh {

/// Triangles that lie on an earlier one, corner on corner and in the same sense, whichever vertices they name: what they enclose counts twice.
struct DoubledTriangles {
  std::size_t count = 0;
  std::optional<std::array<Index, 2>> first = {};  ///< the earlier one and the first of them
};

/// Linear in a mesh without any, else n log n.
DoubledTriangles doubled_triangles(const TriMesh& mesh);

}  // namespace condyle::mesh
