#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "condyle/pose.hpp"
#include "mesh/triangle_tree.hpp"

namespace condyle::contact {

/// Two trees in one pose, X_FM: which nodes may share a point.
///
/// Three tests, each separating most nodes that are apart from those that may meet, in single precision and widened
/// by more than it rounds: shells about the joint centre, boxes seen along the axes of F, boxes seen along the axes
/// of M (six of the fifteen directions of Gottschalk 1996: the nine others seldom separate more).
class PlacedTrees {
 public:
  PlacedTrees(const mesh::TriangleTree& fixed, const mesh::TriangleTree& mobile, const Pose& X_FM) noexcept;

  /// visit(fixed_leaf, mobile_leaf) for each pair of leaves that may share a point, what looks deepest first,
  /// until a visit returns true.
  template <class Visit>
  void visit_leaf_pairs(const Visit& visit) const;

  /// visit(node) for each leaf of a body whose box may share a point with that of all of the other, in the order of places.
  template <class Visit>
  void visit_leaves_at_other(BodyRole own, const Visit& visit) const;

  /// A box of one body seen from the other.
  struct PlacedBox {
    Eigen::Array4f centre, half;  ///< The fourth is 0.
  };
  PlacedBox mobile_in_fixed(const mesh::TriangleTree::Node& node) const noexcept {
    return to_fixed_.placed(node);
  }

 private:
  using Node = mesh::TriangleTree::Node;

  /// Columns of a rotation, the sizes of their entries, and a translation.
  struct Placing {
    std::array<Eigen::Array4f, 3> column, size;
    Eigen::Array4f translation, slack;

    PlacedBox placed(const Node& node) const noexcept {
      const auto& c = node.centre;
      const auto& h = node.half;
      return {column[0] * c[0] + column[1] * c[1] + (column[2] * c[2] + translation),
              size[0] * h[0] + size[1] * h[1] + (size[2] * h[2] + slack)};
    }
  };

  struct NodePair {
    Index fixed, mobile;
    float apart;  ///< Squared distance of the boxes' centres.
    PlacedBox fixed_in_mobile, mobile_in_fixed;
  };
  static Eigen::Array4f array(const std::array<float, 4>& values) noexcept {
    return Eigen::Map<const Eigen::Array4f, Eigen::Aligned16>(values.data());
  }

  /// By how much boxes are apart, above 0.
  static float boxes_apart(const Node& f, const PlacedBox& f_in_m, const Node& m,
                           const PlacedBox& m_in_f) noexcept {
    const Eigen::Array4f in_f = (m_in_f.centre - array(f.centre)).abs() - (m_in_f.half + array(f.half));
    const Eigen::Array4f in_m = (f_in_m.centre - array(m.centre)).abs() - (f_in_m.half + array(m.half));
    return in_f.max(in_m).maxCoeff();
  }
  /// One branch for all: no branch predicts which test separates. A NaN counts as meeting.
  bool may_meet(const Node& f, const PlacedBox& f_in_m, const Node& m,
                const PlacedBox& m_in_f) const noexcept {
    const float shells = std::max(f.nearest - m.farthest, m.nearest - f.farthest) - centres_apart_;
    return !(std::max(shells, boxes_apart(f, f_in_m, m, m_in_f)) > 0);
  }

  const mesh::TriangleTree &fixed_, &mobile_;
  Placing to_fixed_, to_mobile_;
  float centres_apart_;
};

template <class Visit>
void PlacedTrees::visit_leaves_at_other(BodyRole own, const Visit& visit) const {
  if (fixed_.empty() || mobile_.empty()) return;
  const Node &fixed_root = fixed_.nodes()[0], &mobile_root = mobile_.nodes()[0];
  const PlacedBox fixed_in_mobile = to_mobile_.placed(fixed_root),
                  mobile_in_fixed = to_fixed_.placed(mobile_root);
  const auto apart = [&](const Node& node) {
    return own == BodyRole::fixed ? boxes_apart(node, to_mobile_.placed(node), mobile_root, mobile_in_fixed)
                                  : boxes_apart(fixed_root, fixed_in_mobile, node, to_fixed_.placed(node));
  };
  const auto& nodes = (own == BodyRole::fixed ? fixed_ : mobile_).nodes();
  std::vector<Index> open = {0};
  while (!open.empty()) {
    const Node& node = nodes[open.back()];
    open.pop_back();
    if (apart(node) > 0) continue;
    if (node.is_leaf())
      visit(node);
    else
      open.insert(open.end(), {node.child + 1, node.child});
  }
}

template <class Visit>
void PlacedTrees::visit_leaf_pairs(const Visit& visit) const {
  if (fixed_.empty() || mobile_.empty()) return;
  const auto &fixed = fixed_.nodes(), &mobile = mobile_.nodes();
  std::vector<NodePair> open;
  const auto push = [&](Index f, const PlacedBox& f_in_m, Index m, const PlacedBox& m_in_f) {
    if (!may_meet(fixed[f], f_in_m, mobile[m], m_in_f)) return;
    const Eigen::Array4f apart = m_in_f.centre - array(fixed[f].centre);
    open.push_back({f, m, (apart * apart).sum(), f_in_m, m_in_f});
  };
  open.reserve(256);
  push(0, to_mobile_.placed(fixed[0]), 0, to_fixed_.placed(mobile[0]));
  while (!open.empty()) {
    // Piece by piece: read as a whole just after it was written in pieces, it would be waited for.
    const Index f_last = open.back().fixed, m_last = open.back().mobile;
    std::array<PlacedBox, 2> f_in_m = {open.back().fixed_in_mobile, {}};
    std::array<PlacedBox, 2> m_in_f = {open.back().mobile_in_fixed, {}};
    open.pop_back();
    const auto &f = fixed[f_last], &m = mobile[m_last];
    if (f.is_leaf() && m.is_leaf()) {
      if (visit(f_last, m_last)) return;
      continue;
    }
    const bool split_f = !f.is_leaf() && (m.is_leaf() || 2 * f.size() >= m.size());
    const bool split_m = !m.is_leaf() && (f.is_leaf() || 2 * m.size() >= f.size());
    const Index f_first = split_f ? f.child : f_last, m_first = split_m ? m.child : m_last;
    if (split_f) f_in_m = {to_mobile_.placed(fixed[f_first]), to_mobile_.placed(fixed[f_first + 1])};
    if (split_m) m_in_f = {to_fixed_.placed(mobile[m_first]), to_fixed_.placed(mobile[m_first + 1])};
    const std::size_t before = open.size();
    for (Index i = 0; i < (split_m ? 2u : 1u); ++i) {
      for (Index j = 0; j < (split_f ? 2u : 1u); ++j) push(f_first + j, f_in_m[j], m_first + i, m_in_f[i]);
    }
    for (std::size_t i = before; i + 1 < open.size(); ++i) {
      if (open[i].apart < open.back().apart) std::swap(open[i], open.back());
    }
  }
}

}  // namespace condyle::contact
