#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "condyle/mesh.hpp"

namespace condyle::mesh {

/// Where a surface runs through itself.
struct SelfCrossings {
  std::size_t pairs = 0;
  std::optional<std::array<Index, 2>> first;  ///< the least pair, the smaller number first
  std::vector<std::uint8_t> crosses;          ///< of the triangles: 1 for those in a pair
  std::size_t steps = 0;  ///< pairs of boxes that were opened and of triangles that were held together
};

/// Pairs of triangles that share a point and no vertex; vertices at one place are one. What neighbours do to each
/// other beside their common vertex is not tested: a fold that begins there reaches other triangles too unless
/// it is one triangle deep. Exact for the doubles given.
///
/// n log n for a surface with few of them, by a tree of boxes, of slender triangles too; once, and kept with the mesh.
const SelfCrossings& self_crossings_of(const Mesh& mesh);

}  // namespace condyle::mesh
