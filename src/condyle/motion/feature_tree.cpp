#include "condyle/motion/feature_tree.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "condyle/mesh/edge_balance.hpp"

namespace condyle {
namespace {

/// Triangles in a leaf. Fewer make the boxes tighter and the tree larger; 2 to 8 measured within a fifth of
/// each other.
constexpr Index leaf_triangles = 4;

/// Above the rounding of a ball's radius and of its centre when moved, relative to the radius.
constexpr double radius_slack = 1e-12;

using Node = FeatureTree::Node;

/// Splits the triangles at the middle one along the longest side of their centroids' box, again and again.
class Builder {
 public:
  Builder(const TriMesh& mesh, std::vector<Index>& order, std::vector<Node>& nodes)
      : mesh_(mesh), order_(order), nodes_(nodes), centroids_(mesh.triangles.size()) {
    for (std::size_t t = 0; t < centroids_.size(); ++t) {
      centroids_[t] = (mesh.corner(t, 0) + mesh.corner(t, 1) + mesh.corner(t, 2)) / 3;
    }
  }

  void build(Index first, Index last) {
    const auto at = static_cast<Index>(nodes_.size());
    nodes_.emplace_back();
    nodes_[at].triangles = {first, last};
    set_ball(nodes_[at]);
    if (last - first <= leaf_triangles) return;
    const int axis = longest_side(first, last);
    const Index middle = first + (last - first) / 2;
    std::nth_element(order_.begin() + first, order_.begin() + middle, order_.begin() + last,
                     [&](Index a, Index b) {
                       return std::pair(centroids_[a][axis], a) < std::pair(centroids_[b][axis], b);
                     });
    build(first, middle);
    nodes_[at].right = static_cast<Index>(nodes_.size());
    build(middle, last);
  }

 private:
  int longest_side(Index first, Index last) const {
    Eigen::AlignedBox3d box;
    for (Index i = first; i < last; ++i) box.extend(centroids_[order_[i]]);
    int axis = 0;
    box.sizes().maxCoeff(&axis);
    return axis;
  }

  void set_ball(Node& node) const {
    const auto each_corner = [&](const auto& visit) {
      for (Index i = node.triangles.first; i < node.triangles.last; ++i) {
        for (int k = 0; k < 3; ++k) visit(mesh_.corner(order_[i], k));
      }
    };
    Eigen::AlignedBox3d box;
    each_corner([&](const Vec3& p) { box.extend(p); });
    const Vec3 centre = box.center();
    double squared_radius = 0;
    each_corner(
        [&](const Vec3& p) { squared_radius = std::max(squared_radius, (p - centre).squaredNorm()); });
    node.centre = {centre.x(), centre.y(), centre.z()};
    node.radius = std::sqrt(squared_radius) * (1 + radius_slack);
  }

  const TriMesh& mesh_;
  std::vector<Index>& order_;
  std::vector<Node>& nodes_;
  std::vector<Vec3> centroids_;
};

/// An edge, with the place of the first triangle that has it.
struct EdgeUse {
  std::array<Index, 2> ends;
  Index triangle;
};

/// Every edge once, in the order of first use. `uses` may hold it several times.
std::vector<EdgeUse> unique_edges(std::vector<EdgeUse> uses) {
  std::sort(uses.begin(), uses.end(), [](const EdgeUse& a, const EdgeUse& b) {
    return std::tie(a.ends, a.triangle) < std::tie(b.ends, b.triangle);
  });
  const auto same = [](const EdgeUse& a, const EdgeUse& b) { return a.ends == b.ends; };
  uses.erase(std::unique(uses.begin(), uses.end(), same), uses.end());
  std::sort(uses.begin(), uses.end(), [](const EdgeUse& a, const EdgeUse& b) {
    return std::tie(a.triangle, a.ends) < std::tie(b.triangle, b.ends);
  });
  return uses;
}

/// One vertex of each connected piece: union by smallest number.
std::vector<Index> one_of_each_piece(const std::vector<std::array<Index, 2>>& edges, std::size_t vertices) {
  std::vector<Index> root(vertices);
  std::iota(root.begin(), root.end(), Index{0});
  const auto find = [&](Index v) {
    while (root[v] != v) v = root[v] = root[root[v]];
    return v;
  };
  for (const auto& [a, b] : edges) {
    const auto [low, high] = std::minmax({find(a), find(b)});
    root[high] = low;
  }
  std::vector<Index> pieces;
  for (Index v = 0; v < vertices; ++v) {
    if (root[v] == v) pieces.push_back(v);
  }
  return pieces;
}

}  // namespace

FeatureTree::FeatureTree(const TriMesh& mesh) : mesh_triangle_(mesh.triangles.size()) {
  if (mesh.triangles.empty()) return;
  std::iota(mesh_triangle_.begin(), mesh_triangle_.end(), Index{0});
  Builder(mesh, mesh_triangle_, nodes_).build(0, static_cast<Index>(mesh.triangles.size()));

  std::vector<Index> place(mesh.vertices.size(), no_index);
  std::vector<Index> vertices_before = {0};
  std::vector<EdgeUse> uses;
  for (const Index t : mesh_triangle_) {
    Triangle corners{};
    for (std::size_t k = 0; k < 3; ++k) {
      const Index v = mesh.triangles[t][k];
      if (place[v] == no_index) {
        place[v] = static_cast<Index>(mesh_vertex_.size());
        mesh_vertex_.push_back(v);
        const Vec3 p = mesh.vertices[v];
        vertices_.push_back({p.x(), p.y(), p.z()});
      }
      corners[k] = place[v];
    }
    for (std::size_t k = 0; k < 3; ++k) {
      const Index a = corners[k], b = corners[(k + 1) % 3];
      const bool ascending = mesh_vertex_[a] < mesh_vertex_[b];
      uses.push_back({{ascending ? a : b, ascending ? b : a}, static_cast<Index>(triangles_.size())});
    }
    triangles_.push_back(corners);
    vertices_before.push_back(static_cast<Index>(mesh_vertex_.size()));
  }

  std::vector<Index> edges_before(triangles_.size() + 1, 0);
  for (const EdgeUse& use : unique_edges(std::move(uses))) {
    edges_.push_back(use.ends);
    ++edges_before[use.triangle + 1];
  }
  std::partial_sum(edges_before.begin(), edges_before.end(), edges_before.begin());

  for (Node& node : nodes_) {
    node.edges = {edges_before[node.triangles.first], edges_before[node.triangles.last]};
    node.vertices = {vertices_before[node.triangles.first], vertices_before[node.triangles.last]};
  }
  set_distances();
  is_closed_ = !unbalanced_edge(mesh).has_value();
  pieces_ = one_of_each_piece(edges_, vertices_.size());
}

void FeatureTree::set_distances() {
  // Children come after their parent.
  for (std::size_t i = nodes_.size(); i-- > 0;) {
    Node& node = nodes_[i];
    DistanceRange& range = node.from_origin;
    const auto widen = [&](const DistanceRange& more) {
      range = {std::min(range.lo, more.lo), std::max(range.hi, more.hi)};
    };
    if (!node.is_leaf()) {
      range = nodes_[i + 1].from_origin;
      widen(nodes_[node.right].from_origin);
      continue;
    }
    range = {std::numeric_limits<double>::infinity(), 0};
    for (Index t = node.triangles.first; t < node.triangles.last; ++t) {
      const auto [a, b, c] = triangles_[t];
      widen(distance_range(vertices_[a], vertices_[b], vertices_[c]));
    }
  }
}

}  // namespace condyle
