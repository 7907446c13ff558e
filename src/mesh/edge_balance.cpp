#include "mesh/edge_balance.hpp"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "condyle/error.hpp"
#include "mesh/edge_uses.hpp"

namespace condyle::mesh {
namespace {

/// An edge's use by a triangle, to name the one at fault.
struct TriangleEdge {
  std::uint64_t edge;  // smaller vertex in the upper half, larger in the lower
  Index triangle;
  int direction;  // +1 from the smaller to the larger vertex

  Index low() const { return static_cast<Index>(edge >> 32); }
  Index high() const { return static_cast<Index>(edge & 0xffffffffu); }
};

/// Whether the uses of each edge, the same number but for its last bit, are as many in one direction as in
/// the other.
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

std::optional<std::pair<Index, Index>> unbalanced_edge(const TriMesh& mesh) {
  // A use is a number of 32 bits with one to spare.
  if (mesh.vertices.size() < std::size_t{1} << 31 && cancel(uncancelled_edge_uses(mesh.triangles)))
    return std::nullopt;
  std::vector<TriangleEdge> uses;
  uses.reserve(3 * mesh.triangles.size());
  for (Index t = 0; t < mesh.triangles.size(); ++t) {
    for (int k = 0; k < 3; ++k) {
      const Index a = mesh.triangles[t][k], b = mesh.triangles[t][(k + 1) % 3];
      if (a == b) continue;
      const auto [low, high] = std::minmax(a, b);
      uses.push_back({std::uint64_t{low} << 32 | high, t, a < b ? 1 : -1});
    }
  }
  std::sort(uses.begin(), uses.end(), [](const TriangleEdge& a, const TriangleEdge& b) {
    return a.edge != b.edge ? a.edge < b.edge : a.triangle < b.triangle;
  });
  const TriangleEdge* first = nullptr;
  int first_balance = 0;
  for (auto at = uses.begin(); at != uses.end();) {
    int balance = 0;
    const auto begin = at;
    for (; at != uses.end() && at->edge == begin->edge; ++at) balance += at->direction;
    if (balance != 0 && (!first || begin->triangle < first->triangle))
      first = &*begin, first_balance = balance;
  }
  if (!first) return std::nullopt;
  return first_balance > 0 ? std::pair{first->low(), first->high()} : std::pair{first->high(), first->low()};
}

void refuse_unbalanced(const std::pair<Index, Index>& edge) {
  refuse_unbalanced(DirectedEdge{edge.first, edge.second});
}

void refuse_unbalanced(const DirectedEdge& edge) {
  throw MeshError("the surface is open or wound inconsistently at the edge from vertex " +
                  std::to_string(edge.from) + " to vertex " + std::to_string(edge.to) +
                  ": it has no inside; intersecting triangle pairs can still be computed");
}

}  // namespace condyle::mesh
