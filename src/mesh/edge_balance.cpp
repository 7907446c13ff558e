#include "mesh/edge_balance.hpp"

#include <algorithm>
#include <string>

#include "condyle/error.hpp"
#include "mesh/edge_table.hpp"
#include "mesh/edge_uses.hpp"

namespace condyle::mesh {
namespace {

/// Whether the uses of each edge, which differ in the last bit only, are as many in one direction as in the
/// other.
bool cancel(core::UninitialisedVector<EdgeUse> uses) {
  std::sort(uses.begin(), uses.end());
  for (auto at = uses.begin(); at != uses.end();) {
    int balance = 0;
    const EdgeUse edge = *at >> 1;
    for (; at != uses.end() && *at >> 1 == edge; ++at) balance += (*at & 1) == 0 ? 1 : -1;
    if (balance != 0) return false;
  }
  return true;
}

}  // namespace

std::optional<DirectedEdge> first_unbalanced_edge(const TriMesh& mesh) {
  if (cancel(uncancelled_edge_uses(mesh.triangles))) return std::nullopt;
  return EdgeTable(mesh).unbalanced_edge(mesh);
}

void refuse_unbalanced(const DirectedEdge& edge) {
  throw MeshError("the surface is open or wound inconsistently at the edge from vertex " +
                  std::to_string(edge.from) + " to vertex " + std::to_string(edge.to) +
                  ": it has no inside; intersecting triangle pairs can still be computed");
}

}  // namespace condyle::mesh
