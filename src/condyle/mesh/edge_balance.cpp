#include "condyle/mesh/edge_balance.hpp"

#include <algorithm>
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

/// Directed edges, gathered by their smaller vertex: the other one, and the direction in the lowest bit.
///   offset_     0        3  ...    one entry per vertex, plus one
///   other_     | a b c | d ...
class EdgesByVertex {
 public:
  explicit EdgesByVertex(const TriMesh& mesh) : offset_(mesh.vertices.size() + 1, 0) {
    for_each_edge(mesh, [&](Index low, Index, bool) { ++offset_[low + 1]; });
    for (std::size_t v = 1; v < offset_.size(); ++v) offset_[v] += offset_[v - 1];
    other_.resize(offset_.back());
    std::vector<std::size_t> next(offset_.begin(), offset_.end() - 1);
    for_each_edge(mesh, [&](Index low, Index high, bool forward) {
      other_[next[low]++] = std::uint64_t{high} << 1 | std::uint64_t{forward};
    });
  }

  /// Whether each edge is used as often in one direction as in the other.
  bool balanced() {
    for (std::size_t v = 0; v + 1 < offset_.size(); ++v) {
      const auto begin = other_.begin() + offset_[v], end = other_.begin() + offset_[v + 1];
      std::sort(begin, end);
      for (auto at = begin; at != end;) {
        int balance = 0;
        const std::uint64_t other = *at >> 1;
        for (; at != end && *at >> 1 == other; ++at) balance += (*at & 1) != 0 ? 1 : -1;
        if (balance != 0) return false;
      }
    }
    return true;
  }

 private:
  template <class Visit>
  static void for_each_edge(const TriMesh& mesh, const Visit& visit) {
    for (const auto& [a, b, c] : mesh.triangles) {
      for (const auto& [from, to] : {std::pair{a, b}, std::pair{b, c}, std::pair{c, a}}) {
        if (from != to) visit(std::min(from, to), std::max(from, to), from < to);
      }
    }
  }

  std::vector<std::size_t> offset_;
  std::vector<std::uint64_t> other_;
};

}  // namespace

std::optional<std::pair<Index, Index>> unbalanced_edge(const TriMesh& mesh) {
  // The usual mesh is closed: that is told without sorting all edges.
  if (EdgesByVertex(mesh).balanced()) return std::nullopt;
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
