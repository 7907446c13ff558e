#include "motion/search/feature_tree.hpp"

#include <algorithm>
#include <cmath>

namespace condyle::motion {
namespace {

/// Every edge once, found again by its end of the smaller place.
///   offset_     0        3  ...    one entry per vertex, plus one
///   met_       | a b . | d ...     as many entries as edges may come, those met so far first
class EdgesMet {
 public:
  EdgesMet(const std::vector<Triangle>& triangles, std::size_t vertices)
      : offset_(vertices + 1, 0), count_(vertices, 0) {
    for (const auto& [a, b, c] : triangles) {
      for (const Index low : {std::min(a, b), std::min(b, c), std::min(c, a)}) ++offset_[low + 1];
    }
    for (std::size_t v = 1; v < offset_.size(); ++v) offset_[v] += offset_[v - 1];
    met_.resize(offset_.back());
  }

  /// Whether the edge is met for the first time.
  bool meet(Index from, Index to) noexcept {
    const Index low = std::min(from, to), high = std::max(from, to);
    Index* const begin = met_.data() + offset_[low];
    Index* const end = begin + count_[low];
    if (std::find(begin, end, high) != end) return false;
    *end = high;
    ++count_[low];
    return true;
  }

 private:
  std::vector<Index> offset_, count_, met_;
};

}  // namespace

FeatureTree::FeatureTree(const Mesh& mesh) : base_(mesh), is_closed_(mesh.is_closed()) {
  count_vertices();
  gather_edges();
  pieces_ = base_.one_vertex_of_each_piece();
}

/// Vertices are placed in the order in which triangles first use them.
void FeatureTree::count_vertices() {
  vertices_before_.reserve(triangles().size() + 1);
  vertices_before_.push_back(0);
  for (const auto& [a, b, c] : triangles())
    vertices_before_.push_back(std::max({vertices_before_.back(), a + 1, b + 1, c + 1}));
}

void FeatureTree::gather_edges() {
  EdgesMet met(triangles(), vertices().size());
  edges_.reserve(3 * triangles().size() / 2);
  edges_before_.reserve(triangles().size() + 1);
  edges_before_.push_back(0);
  for (const auto& [a, b, c] : triangles()) {
    for (const auto& [from, to] : {std::pair{a, b}, std::pair{b, c}, std::pair{c, a}}) {
      // A side without length is its vertex.
      if (from == to || !met.meet(from, to)) continue;
      const bool ascending = mesh_vertex(from) < mesh_vertex(to);
      edges_.push_back({ascending ? from : to, ascending ? to : from});
    }
    edges_before_.push_back(static_cast<Index>(edges_.size()));
  }
}

NodeBall ball_of(const mesh::TriangleTree::Node& node) noexcept {
  const auto square = [](double a) { return a * a; };
  const auto& [x, y, z, none] = node.half;
  // More than the roundings of the sum and of the root.
  constexpr double radius_slack = 1e-12;
  return {{node.centre[0], node.centre[1], node.centre[2]},
          std::sqrt(square(x) + square(y) + square(z)) * (1 + radius_slack)};
}

}  // namespace condyle::motion
