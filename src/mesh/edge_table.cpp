#include "mesh/edge_table.hpp"

#include <algorithm>
#include <cstdint>
#include <numeric>

#include "mesh/disjoint_sets.hpp"

namespace condyle::mesh {
namespace {

/// A half-edge among those of one smaller vertex: they sort by larger vertex, then by number.
struct Entry {
  Index high;
  HalfEdge h;

  auto operator<=>(const Entry&) const = default;
};

/// visit(h, smaller vertex, larger vertex) for each half-edge that is not from a vertex to itself, ascending.
template <class Visit>
void for_each_half_edge(const TriMesh& mesh, const Visit& visit) {
  HalfEdge h = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    if (a != b) visit(h, std::min(a, b), std::max(a, b));
    if (b != c) visit(h + 1, std::min(b, c), std::max(b, c));
    if (c != a) visit(h + 2, std::min(c, a), std::max(c, a));
    h += 3;
  }
}

}  // namespace

EdgeTable::EdgeTable(const TriMesh& mesh) : edge_of_(3 * mesh.triangles.size(), no_index) {
  // By smaller vertex: vertex v owns entries [first[v], first[v + 1]).
  std::vector<Index> first(mesh.vertices.size() + 2, 0);
  for_each_half_edge(mesh, [&](HalfEdge, Index low, Index) { ++first[low + 2]; });
  std::partial_sum(first.begin(), first.end(), first.begin());
  std::vector<Entry> entries(first.back());
  for_each_half_edge(mesh, [&](HalfEdge h, Index low, Index high) { entries[first[low + 1]++] = {high, h}; });

  half_edge_.resize(entries.size());
  ends_.reserve(entries.size() / 2 + 1), offset_.reserve(entries.size() / 2 + 2);
  for (Index low = 0; low < mesh.vertices.size(); ++low) {
    std::sort(entries.begin() + first[low], entries.begin() + first[low + 1]);
    for (Index i = first[low]; i < first[low + 1]; ++i) {
      const auto [high, h] = entries[i];
      if (i == first[low] || entries[i - 1].high != high) ends_.push_back({low, high}), offset_.push_back(i);
      half_edge_[i] = h;
      edge_of_[h] = static_cast<Index>(ends_.size() - 1);
    }
  }
  offset_.push_back(static_cast<Index>(entries.size()));
}

int EdgeTable::balance(const TriMesh& mesh, std::size_t edge) const noexcept {
  int balance = 0;
  for (const HalfEdge h : half_edges(edge))
    balance += mesh.triangles[h / 3][h % 3] == ends_[edge][0] ? 1 : -1;
  return balance;
}

std::optional<DirectedEdge> EdgeTable::unbalanced_edge(const TriMesh& mesh) const noexcept {
  std::optional<DirectedEdge> unbalanced;
  Index first_triangle = no_index;
  for (std::size_t e = 0; e < size(); ++e) {
    const Index triangle = half_edges(e)[0] / 3;
    if (triangle >= first_triangle) continue;
    const int surplus = balance(mesh, e);
    if (surplus == 0) continue;
    const auto [low, high] = ends(e);
    unbalanced = surplus > 0 ? DirectedEdge{low, high} : DirectedEdge{high, low};
    first_triangle = triangle;
  }
  return unbalanced;
}

ConnectedComponents EdgeTable::components() const {
  const std::size_t triangles = edge_of_.size() / 3;
  DisjointSets connected(triangles);
  for (std::size_t e = 0; e < size(); ++e) {
    for (const HalfEdge h : half_edges(e).subspan(1)) connected.join(half_edges(e)[0] / 3, h / 3);
  }
  ConnectedComponents components;
  components.of_triangle.resize(triangles);
  for (Index t = 0; t < triangles; ++t) {
    const Index root = connected.find(t);
    if (root == t) components.first_triangle.push_back(t);
    components.of_triangle[t] =
        root == t ? static_cast<Index>(components.first_triangle.size() - 1) : components.of_triangle[root];
  }
  return components;
}

}  // namespace condyle::mesh
