#pragma once

#include <cstdint>
#include <span>

#include "condyle/mesh.hpp"
#include "core/uninitialised.hpp"

namespace condyle::mesh {

/// The lower vertex in the upper half; in the lower half twice the higher vertex, plus one where the edge
/// comes from there. So the use in the opposite direction differs in the last bit, and none is 0.
using EdgeUse = std::uint64_t;

/// The uses of edges by triangles, less pairs of opposite ones: of a closed mesh nearly always none, of
/// another one those at its borders and perhaps some that still cancel one another. An edge from a vertex to
/// itself is no use.
///
/// Vertices are fewer than 2^31. Linear in the number of triangles, in whichever order they are: the nearer
/// those at one edge, the faster.
core::UninitialisedVector<EdgeUse> uncancelled_edge_uses(std::span<const Triangle> triangles);

}  // namespace condyle::mesh
