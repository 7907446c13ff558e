#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "condyle/mesh.hpp"

namespace condyle::mesh {

/// Triangles that lie on an earlier one, corner on corner, whichever vertices they name: in the same sense, and what they enclose counts twice;
/// or in the opposite one, as a wall without thickness, which encloses nothing.
struct DoubledTriangles {
  std::size_t count = 0, opposite = 0;
  std::optional<std::array<Index, 2>> first = {};  ///< the earlier one and the first in the same sense
  std::optional<std::array<Index, 2>> first_opposite = {};
  std::size_t single = 0;  ///< triangles with none in the opposite sense
  /// Every triangle is there in both senses: the mesh has no inside.
  bool is_two_sided() const noexcept { return opposite > 0 && single == 0; }
};

/// Linear in a mesh without any, else n log n.
DoubledTriangles doubled_triangles(const TriMesh& mesh);

/// doubled_triangles().is_two_sided(), in a linear look at most meshes: those that enclose more than rounding are not.
bool is_two_sided(const TriMesh& mesh);

/// After the name of a mesh that is two-sided.
inline constexpr const char* two_sided_text =
    "every triangle is there twice, once in each sense: the mesh has no inside; export its surface once, "
    "with "
    "normals outwards";

}  // namespace condyle::mesh
