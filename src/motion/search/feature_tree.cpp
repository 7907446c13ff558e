#include "motion/search/feature_tree.hpp"

#include <algorithm>
#include <cmath>

namespace condyle::motion {
namespace {

/// Every edge once, found again by its end in the lower slot.
///   offset_     0        3  ...    one entry per vertex, plus one
///   higher_    | a b . | d ...     as many entries as edges may come, those found so far first
class KnownEdges {
 public:
  KnownEdges(const std::vector<Triangle>& triangles, std::size_t vertices)
      : offset_(vertices + 1, 0), count_(vertices, 0) {
    for (const auto& [a, b, c] : triangles) {
      for (const Index low : {std::min(a, b), std::min(b, c), std::min(c, a)}) ++offset_[low + 1];
    }
    for (std::size_t v = 1; v < offset_.size(); ++v) offset_[v] += offset_[v - 1];
    higher_.resize(offset_.back());
  }

  /// Whether the edge was not known yet; now it is.
  bool insert(Index from, Index to) noexcept {
    const auto [low, high] = std::minmax(from, to);
    Index* const begin = higher_.data() + offset_[low];
    Index* const end = begin + count_[low];
    if (std::find(begin, end, high) != end) return false;
    *end = high;
    ++count_[low];
    return true;
  }

 private:
  std::vector<Index> offset_, count_, higher_;
};

}  // namespace

FeatureTree::FeatureTree(const Mesh& mesh) : base_(mesh), is_closed_(mesh.is_closed()) {
  count_vertices();
  gather_edges();
  component_vertices_ = base_.one_vertex_of_each_piece();
}

/// The order of vertices is that in which triangles first use them.
void FeatureTree::count_vertices() {
  vertices_before_.reserve(triangles().size() + 1);
  vertices_before_.push_back(0);
  for (const auto& [a, b, c] : triangles())
    vertices_before_.push_back(std::max({vertices_before_.back(), a + 1, b + 1, c + 1}));
}

void FeatureTree::gather_edges() {
  KnownEdges known(triangles(), vertices().size());
  edges_.reserve(3 * triangles().size() / 2);
  edges_before_.reserve(triangles().size() + 1);
  edges_before_.push_back(0);
  for (const auto& [a, b, c] : triangles()) {
    for (const auto& [from, to] : {std::pair{a, b}, std::pair{b, c}, std::pair{c, a}}) {
      // A side without length is its vertex.
      if (from == to || !known.insert(from, to)) continue;
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
