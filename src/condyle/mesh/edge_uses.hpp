#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "condyle/mesh/tri_mesh.hpp"

namespace condyle {

/// Lets uses of edges in opposite directions cancel, in one pass over the triangles, and adds those that did
/// not to `left_over`: of a closed mesh of ordinary vertices, none; else they may still cancel one another. A
/// use is the lower vertex in the upper half; in the lower half twice the higher vertex, plus one where the
/// edge comes from there. An edge from a vertex to itself is no use.
///
/// Vertices are fewer than 2^31.
void cancel_edge_uses(std::span<const Triangle> triangles, std::size_t vertices,
                      std::vector<std::uint64_t>& left_over);

/// Uses of edges from one vertex to higher ones that wait for a use in the other direction, anywhere among
/// `none`. Around a vertex of a mesh few wait at a time, whatever the order of its triangles.
struct alignas(32) WaitingUses {
  static constexpr std::uint32_t none = 0xffffffffu;
  std::uint32_t use[8];
};

}  // namespace condyle
