#include "condyle/mesh/edge_balance.hpp"

#include <algorithm>
#include <array>
#include <string>

#include "condyle/core/error.hpp"

namespace condyle {
namespace {

struct EdgeUse {
  std::uint64_t edge;  // smaller vertex in the upper half, larger in the lower
  Index triangle;
  int direction;  // +1 from the smaller to the larger vertex

  Index low() const { return static_cast<Index>(edge >> 32); }
  Index high() const { return static_cast<Index>(edge & 0xffffffffu); }
};

/// Uses of edges from one vertex to higher ones that wait for a use in the other direction. Around a vertex
/// of a mesh few wait at a time, whatever the order of its triangles.
struct Waiting {
  static constexpr std::size_t most = 7;
  std::uint32_t count = 0;
  std::array<std::uint32_t, most> use;  // twice the higher vertex, plus one where the edge comes from there

  /// Takes the opposite use out, or puts this one in; false where there is no room.
  bool meet(std::uint32_t asked) noexcept {
    const std::uint32_t opposite = asked ^ 1u;
    for (std::uint32_t i = 0; i < count; ++i) {
      if (use[i] != opposite) continue;
      use[i] = use[--count];
      return true;
    }
    if (count == most) return false;
    use[count++] = asked;
    return true;
  }
};

/// Whether the uses of each edge, the same number but for its last bit, are as many in one direction as in
/// the other.
bool cancel(std::vector<std::uint64_t> uses) {
  std::sort(uses.begin(), uses.end());
  for (auto at = uses.begin(); at != uses.end();) {
    int balance = 0;
    const std::uint64_t edge = *at >> 1;
    for (; at != uses.end() && *at >> 1 == edge; ++at) balance += (*at & 1) == 0 ? 1 : -1;
    if (balance != 0) return false;
  }
  return true;
}

/// Whether every edge is used as often in one direction as in the other: uses cancel in pairs as they come,
/// and what is left over, if anything, is sorted. Linear for a closed mesh.
bool edges_balance(const TriMesh& mesh) {
  std::vector<Waiting> waiting(mesh.vertices.size());
  std::vector<std::uint64_t> left_over;
  const auto keep = [&](Index low, std::uint32_t use) {
    left_over.push_back(std::uint64_t{low} << 32 | use);
  };
  for (const Triangle& triangle : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Index a = triangle[k], b = triangle[k == 2 ? 0 : k + 1];
      if (a == b) continue;
      const Index low = std::min(a, b), high = std::max(a, b);
      const std::uint32_t use = 2 * high + static_cast<Index>(a == high);
      if (!waiting[low].meet(use)) keep(low, use);
    }
  }
  for (Index low = 0; low < waiting.size(); ++low) {
    for (std::uint32_t i = 0; i < waiting[low].count; ++i) keep(low, waiting[low].use[i]);
  }
  return cancel(std::move(left_over));
}

}  // namespace

std::optional<std::pair<Index, Index>> unbalanced_edge(const TriMesh& mesh) {
  // A use is a number of 32 bits with one to spare.
  if (mesh.vertices.size() < std::size_t{1} << 31 && edges_balance(mesh)) return std::nullopt;
  std::vector<EdgeUse> uses;
  uses.reserve(3 * mesh.triangles.size());
  for (Index t = 0; t < mesh.triangles.size(); ++t) {
    for (int k = 0; k < 3; ++k) {
      const Index a = mesh.triangles[t][k], b = mesh.triangles[t][(k + 1) % 3];
      if (a == b) continue;
      const auto [low, high] = std::minmax(a, b);
      uses.push_back({std::uint64_t{low} << 32 | high, t, a < b ? 1 : -1});
    }
  }
  std::sort(uses.begin(), uses.end(), [](const EdgeUse& a, const EdgeUse& b) {
    return a.edge != b.edge ? a.edge < b.edge : a.triangle < b.triangle;
  });
  const EdgeUse* first = nullptr;
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
  throw MeshError("the surface is open or wound inconsistently at the edge from vertex " +
                  std::to_string(edge.first) + " to vertex " + std::to_string(edge.second) +
                  ": it has no inside; intersecting triangle pairs can still be computed");
}

}  // namespace condyle
