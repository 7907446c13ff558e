#include "motion/search/path_clearance.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "mesh/triangle_distance.hpp"
#include "motion/search/node_pairs.hpp"

namespace condyle::motion {
namespace {

using mesh::between_triangles;
using mesh::nearest_on_triangle;
using mesh::NearestPoints;

using Corners3 = std::array<Vec3, 3>;

/// In mm. Coordinates below 10 m carry 2e-12 from one rounding; a distance goes through fewer than a hundred
/// operations on them.
constexpr double rounding_mm = 1e-9;

struct Radii {
  double low, high;

  bool meet(const Radii& other) const noexcept {
    return low <= other.high + rounding_mm && other.low <= high + rounding_mm;
  }
};

Radii radii_of(const Corners3& t) noexcept {
  return {nearest_on_triangle(Vec3::Zero(), t).norm(), std::max({t[0].norm(), t[1].norm(), t[2].norm()})};
}

class Search {
 public:
  Search(const FeatureTree& fixed, const FeatureTree& mobile, const Pose& X_FM, double enough)
      : fixed_(fixed), mobile_(mobile), X_FM_(X_FM), best_rotation_(enough) {}

  std::optional<Clearance> run() {
    if (fixed_.empty() || mobile_.empty()) return std::nullopt;
    push(0, 0);
    while (!open_.empty()) {
      const NodePair pair = open_.back();
      open_.pop_back();
      if (pair.gap >= best_rotation_) continue;
      const auto &m = mobile_.nodes()[pair.turning], &f = fixed_.nodes()[pair.resting];
      if (m.is_leaf() && f.is_leaf()) {
        compare_leaves(m, f);
        continue;
      }
      const std::size_t before = open_.size();
      split(mobile_, fixed_, pair, [&](Index a, Index b) { push(a, b); });
      if (open_.size() == before + 2 && open_[before].gap < open_[before + 1].gap)
        std::swap(open_[before], open_[before + 1]);
    }
    return found_;
  }

 private:
  void push(Index mobile, Index fixed) {
    const auto &m = mobile_.nodes()[mobile], &f = fixed_.nodes()[fixed];
    if (!Radii{m.nearest, m.farthest}.meet({f.nearest, f.farthest})) return;
    const NodeBall of_mobile = ball_of(m), of_fixed = ball_of(f);
    const double apart = (posed(X_FM_, of_mobile.centre) - of_fixed.centre).norm() - of_mobile.radius -
                         of_fixed.radius - rounding_mm;
    const double rotation = std::max(apart, 0.0) / m.farthest;
    if (rotation < best_rotation_) open_.push_back({mobile, fixed, rotation});
  }

  Corners3 corners(const FeatureTree& tree, Index t) const {
    const auto [a, b, c] = tree.triangles()[t];
    return {tree.vertices()[a], tree.vertices()[b], tree.vertices()[c]};
  }

  void compare_leaves(const FeatureTree::Node& m, const FeatureTree::Node& f) {
    for (Index s = m.first; s < m.last; ++s) {
      const Corners3 own = corners(mobile_, s);
      const Radii radii = radii_of(own);
      const Corners3 placed{posed(X_FM_, own[0]), posed(X_FM_, own[1]), posed(X_FM_, own[2])};
      for (Index t = f.first; t < f.last; ++t) {
        const Corners3 fixed = corners(fixed_, t);
        if (!radii.meet(radii_of(fixed))) continue;
        const NearestPoints nearest = between_triangles(fixed, placed);
        const double distance = std::sqrt(nearest.squared_distance);
        const double rotation = std::max(distance - rounding_mm, 0.0) / radii.high;
        if (rotation >= best_rotation_) continue;
        best_rotation_ = rotation;
        found_ = Clearance{rotation, distance, t, s, nearest.a, nearest.b};
      }
    }
  }

  const FeatureTree &fixed_, &mobile_;
  const Pose& X_FM_;
  double best_rotation_;
  std::vector<NodePair> open_;
  std::optional<Clearance> found_;
};

}  // namespace

std::optional<Clearance> clearance(const FeatureTree& fixed, const FeatureTree& mobile, const Pose& X_FM,
                                   double enough) {
  return Search(fixed, mobile, X_FM, enough).run();
}

}  // namespace condyle::motion
