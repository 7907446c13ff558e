#pragma once

#include <algorithm>
#include <memory>
#include <numeric>
#include <span>
#include <vector>

#include "mesh/triangle_intersection.hpp"
#include "method.hpp"

/// Hierarchies of bounding volumes in plain code, for volumes that no library has. What they share: the tree,
/// the walk of two trees and the exact test of triangles. They differ in the volume alone:
///
///   static Volume around(std::span<const Vec3> corners)   holds these triangles, three corners each
///   Volume posed(const Pose&) const                       holds them moved, rounding included
///   bool meets(const Volume&) const                       false only where no point is in both
///   double size() const                                   of two nodes the larger is split
///   static Volume joined(const Volume&, const Volume&)    optional: the tree is then updated by halves
///
/// A volume that holds its triangles and an exact test at the leaves make the answers exact.

namespace bench {

/// Above the rounding of a point that is moved by a pose and then compared, relative to its size: about forty
/// roundings of 1.1e-16 each.
inline constexpr double relative_rounding = 1e-14;

/// Whether a tree of these follows a deformation by halves: the upper one at once, joined from the volumes of the middle
/// level, and a volume below when it is visited.
template <class Volume>
inline constexpr bool updates_by_halves = requires(const Volume& v) {
  Volume::joined(v, v);
};

/// A binary tree over the triangles of a mesh, one of them in a leaf.
///
///   node    0               children of node i: i + 1 and node[i].right
///          / .
///         1   4             leaves own one place each in the order of triangles
///        / .  ...
///       2   3
template <class Volume>
class VolumeTree {
 public:
  struct Node {
    Volume volume;
    condyle::Index first, last;  ///< Triangles, in order_.
    condyle::Index right;        ///< 0 for a leaf.
    condyle::Index level = 0;    ///< 0 for the root.
    unsigned fitted = 0;         ///< To the vertices of this update.

    bool is_leaf() const { return right == 0; }
  };

  explicit VolumeTree(const condyle::TriMesh& mesh)
      : vertices_(mesh.vertices.view()), triangles_(&mesh.triangles), order_(mesh.triangles.size()) {
    std::iota(order_.begin(), order_.end(), condyle::Index{0});
    std::vector<condyle::Vec3> centroids(order_.size());
    for (const condyle::Index t : order_) centroids[t] = (corner(t, 0) + corner(t, 1) + corner(t, 2)) / 3;
    nodes_.reserve(2 * order_.size());
    if (!order_.empty()) build(0, static_cast<condyle::Index>(order_.size()), 0, centroids);
    for (Node& node : nodes_) fit(node);
  }

  /// The same tree about moved vertices.
  void refit(condyle::PointsView vertices) {
    vertices_ = vertices;
    ++updates_;
    if constexpr (updates_by_halves<Volume>) {
      if (!empty()) fit_upper_half(0);
    } else {
      for (Node& node : nodes_) fit(node);
    }
  }

  bool empty() const { return nodes_.empty(); }
  const Node& node(condyle::Index i) {
    if constexpr (updates_by_halves<Volume>)
      if (nodes_[i].fitted != updates_) fit(nodes_[i]);
    return nodes_[i];
  }
  condyle::Index triangle(condyle::Index place) const { return order_[place]; }
  condyle::Vec3 corner(condyle::Index t, int k) const { return vertices_[(*triangles_)[t][k]]; }
  std::size_t bytes() const { return nodes_.size() * sizeof(Node) + order_.size() * sizeof(condyle::Index); }

 private:
  void build(condyle::Index first, condyle::Index last, condyle::Index level,
             const std::vector<condyle::Vec3>& centroids) {
    const std::size_t at = nodes_.size();
    nodes_.push_back({{}, first, last, 0, level});
    middle_level_ = std::max(middle_level_, (level + 1) / 2);
    if (last - first == 1) return;
    Eigen::AlignedBox3d box;
    for (condyle::Index i = first; i < last; ++i) box.extend(centroids[order_[i]]);
    int axis = 0;
    box.sizes().maxCoeff(&axis);
    const condyle::Index middle = first + (last - first) / 2;
    std::nth_element(order_.begin() + first, order_.begin() + middle, order_.begin() + last,
                     [&](condyle::Index a, condyle::Index b) {
                       return std::pair(centroids[a][axis], a) < std::pair(centroids[b][axis], b);
                     });
    build(first, middle, level + 1, centroids);
    nodes_[at].right = static_cast<condyle::Index>(nodes_.size());
    build(middle, last, level + 1, centroids);
  }

  void fit(Node& node) {
    corners_.clear();
    for (condyle::Index i = node.first; i < node.last; ++i)
      for (int k = 0; k < 3; ++k) corners_.push_back(corner(order_[i], k));
    node.volume = Volume::around(corners_);
    node.fitted = updates_;
  }

  void fit_upper_half(condyle::Index i) {
    Node& node = nodes_[i];
    if (node.is_leaf() || node.level >= middle_level_) return fit(node);
    fit_upper_half(i + 1), fit_upper_half(node.right);
    node.volume = Volume::joined(nodes_[i + 1].volume, nodes_[node.right].volume);
    node.fitted = updates_;
  }

  condyle::PointsView vertices_;
  const std::vector<condyle::Triangle>* triangles_;
  std::vector<condyle::Index> order_;
  std::vector<Node> nodes_;
  std::vector<condyle::Vec3> corners_;
  condyle::Index middle_level_ = 0;
  unsigned updates_ = 0;
};

/// Both bodies in such trees.
template <class Volume>
class TwoTrees final : public Method {
 public:
  explicit TwoTrees(const Bodies& bodies)
      : fixed_(std::make_shared<Tree>(bodies.fixed)), mobile_(std::make_shared<Tree>(bodies.mobile)) {}

  bool touch(const condyle::Pose& X_FM) override {
    bool found = false;
    walk(X_FM, [&](condyle::Index, condyle::Index) { return !(found = true); });
    return found;
  }

  void find_pairs(const condyle::Pose& X_FM, std::vector<condyle::contact::TrianglePair>& out) override {
    out.clear();
    walk(X_FM, [&](condyle::Index f, condyle::Index m) {
      out.push_back({f, m});
      return true;
    });
  }

  void deform(condyle::PointsView fixed_vertices) override {
    if (fixed_.use_count() > 1) fixed_ = std::make_shared<Tree>(*fixed_);
    fixed_->refit(fixed_vertices);
  }

  std::unique_ptr<Method> for_another_thread() override {
    auto other = std::make_unique<TwoTrees>(*this);
    if constexpr (updates_by_halves<Volume>) other->fixed_ = std::make_shared<Tree>(*fixed_);
    return other;
  }
  std::size_t bytes() const override { return fixed_->bytes() + mobile_->bytes(); }
  Work work() const override {
    return {{"volume tests", volume_tests_}, {"triangle tests", triangle_tests_}};
  }

 private:
  using Tree = VolumeTree<Volume>;

  /// Calls visit(fixed triangle, mobile triangle) for every pair that shares a point, until it says no.
  template <class Visit>
  void walk(const condyle::Pose& X_FM, const Visit& visit) {
    if (!fixed_->empty() && !mobile_->empty())
      walk_pair(X_FM, 0, 0, mobile_->node(0).volume.posed(X_FM), visit);
  }

  template <class Visit>
  bool walk_pair(const condyle::Pose& X_FM, condyle::Index f, condyle::Index m, const Volume& posed_m,
                 const Visit& visit) {
    ++volume_tests_;
    const auto &fixed = fixed_->node(f), &mobile = mobile_->node(m);
    if (!fixed.volume.meets(posed_m)) return true;
    if (fixed.is_leaf() && mobile.is_leaf()) {
      const condyle::Index t = fixed_->triangle(fixed.first), u = mobile_->triangle(mobile.first);
      return !triangles_meet(X_FM, t, u) || visit(t, u);
    }
    if (mobile.is_leaf() || (!fixed.is_leaf() && fixed.volume.size() > posed_m.size()))
      return walk_pair(X_FM, f + 1, m, posed_m, visit) && walk_pair(X_FM, fixed.right, m, posed_m, visit);
    for (const condyle::Index child : {m + 1, mobile.right})
      if (!walk_pair(X_FM, f, child, mobile_->node(child).volume.posed(X_FM), visit)) return false;
    return true;
  }

  bool triangles_meet(const condyle::Pose& X_FM, condyle::Index f, condyle::Index m) {
    ++triangle_tests_;
    const auto p = [&](int k) { return fixed_->corner(f, k); };
    const auto q = [&](int k) { return condyle::posed(X_FM, mobile_->corner(m, k)); };
    return condyle::mesh::triangles_intersect({p(0), p(1), p(2)}, {q(0), q(1), q(2)});
  }

  std::shared_ptr<Tree> fixed_, mobile_;
  std::int64_t volume_tests_ = 0, triangle_tests_ = 0;
};

}  // namespace bench
