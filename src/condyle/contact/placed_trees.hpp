#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "condyle/contact/triangle_tree.hpp"
#include "condyle/core/pose.hpp"

namespace condyle {

/// Two trees in one pose, X_FM: which nodes may share a point.
///
/// Three tests, each telling most of what is apart from what may meet, in single precision and widened by
/// more than it rounds: shells about the joint centre, boxes seen along the axes of F, boxes seen along the
/// axes of M (six of the fifteen directions of Gottschalk 1996: the nine others seldom tell more).
class PlacedTrees {
 public:
  PlacedTrees(const TriangleTree& fixed, const TriangleTree& mobile, const Pose& X_FM) noexcept;

  /// visit(fixed_leaf, mobile_leaf) for each pair of leaves that may share a point, what looks deepest first,
  /// until a visit returns true.
  template <class Visit>
  void visit_leaf_pairs(const Visit& visit) const;

  /// A box of M seen from F.
  struct PlacedBox {
    Eigen::Array4f centre, half;  ///< The fourth is 0.
  };
  PlacedBox placed(const TriangleTree::Node& mobile) const noexcept {
    const auto& c = mobile.centre;
    const auto& h = mobile.half;
    return {column_[0] * c[0] + column_[1] * c[1] + (column_[2] * c[2] + translation_),
            size_[0] * h[0] + size_[1] * h[1] + (size_[2] * h[2] + slack_)};
  }

 private:
  struct NodePair {
    Index fixed, mobile;
    float apart;    ///< Squared distance of the boxes' centres.
    PlacedBox box;  ///< Of the mobile node.
  };
  static Eigen::Array4f array(const std::array<float, 4>& values) noexcept {
    return Eigen::Map<const Eigen::Array4f, Eigen::Aligned16>(values.data());
  }

  bool may_meet(const TriangleTree::Node& f, const TriangleTree::Node& m,
                const PlacedBox& box) const noexcept {
    // One branch for all: which test tells is anybody's guess. What is not a number counts as meeting.
    const float shells = std::max(f.nearest - m.farthest, m.nearest - f.farthest) - centres_apart_;
    const Eigen::Array4f apart = box.centre - array(f.centre);
    const Eigen::Array4f in_mobile = row_[0] * apart[0] + row_[1] * apart[1] + row_[2] * apart[2];
    const Eigen::Array4f reach =
        row_size_[0] * f.half[0] + row_size_[1] * f.half[1] + (row_size_[2] * f.half[2] + slack_);
    const Eigen::Array4f seen_from_f = apart.abs() - (box.half + array(f.half));
    const Eigen::Array4f seen_from_m = in_mobile.abs() - (reach + array(m.half));
    return !(std::max(shells, seen_from_f.max(seen_from_m).maxCoeff()) > 0);
  }

  const TriangleTree &fixed_, &mobile_;
  /// Columns of R_FM and of its transpose, and the sizes of their entries.
  std::array<Eigen::Array4f, 3> column_, size_, row_, row_size_;
  Eigen::Array4f translation_, slack_;
  float centres_apart_;
};

template <class Visit>
void PlacedTrees::visit_leaf_pairs(const Visit& visit) const {
  if (fixed_.empty() || mobile_.empty()) return;
  const auto &fixed = fixed_.nodes(), &mobile = mobile_.nodes();
  std::vector<NodePair> open;
  const auto push = [&](Index f, Index m, const PlacedBox& box) {
    if (!may_meet(fixed[f], mobile[m], box)) return;
    const Eigen::Array4f apart = box.centre - array(fixed[f].centre);
    open.push_back({f, m, (apart * apart).sum(), box});
  };
  open.reserve(256);
  push(0, 0, placed(mobile[0]));
  while (!open.empty()) {
    const NodePair pair = open.back();
    open.pop_back();
    const auto &f = fixed[pair.fixed], &m = mobile[pair.mobile];
    if (f.is_leaf() && m.is_leaf()) {
      if (visit(pair.fixed, pair.mobile)) return;
      continue;
    }
    const bool split_f = !f.is_leaf() && (m.is_leaf() || 2 * f.size() >= m.size());
    const bool split_m = !m.is_leaf() && (f.is_leaf() || 2 * m.size() >= f.size());
    const Index f_first = split_f ? f.child : pair.fixed, m_first = split_m ? m.child : pair.mobile;
    const std::size_t before = open.size();
    for (Index i = 0; i < (split_m ? 2u : 1u); ++i) {
      const PlacedBox box = split_m ? placed(mobile[m_first + i]) : pair.box;
      for (Index j = 0; j < (split_f ? 2u : 1u); ++j) push(f_first + j, m_first + i, box);
    }
    for (std::size_t i = before; i + 1 < open.size(); ++i) {
      if (open[i].apart < open.back().apart) std::swap(open[i], open.back());
    }
  }
}

}  // namespace condyle
