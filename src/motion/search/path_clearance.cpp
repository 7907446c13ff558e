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

  /// 0 or less where they overlap.
  double apart_from(const Radii& other) const noexcept {
    return std::max(low - other.high, other.low - high) - rounding_mm;
  }
};

/// From `origin`.
Radii radii_of(const Corners3& t, const Vec3& origin) noexcept {
  return {(nearest_on_triangle(origin, t) - origin).norm(),
          std::max({(t[0] - origin).norm(), (t[1] - origin).norm(), (t[2] - origin).norm()})};
}

class ClearanceSearch {
 public:
  ClearanceSearch(const FeatureTree& fixed, const FeatureTree& mobile, const Pose& X_FM, double enough,
                  const Speed& speed)
      : fixed_(fixed),
        mobile_(mobile),
        X_FM_(X_FM),
        origin_(X_FM.translation()),
        origin_off_(origin_.norm()),
        speed_(speed),
        free_for_(enough) {}

  std::optional<Clearance> run() {
    if (fixed_.empty() || mobile_.empty()) return std::nullopt;
    push(0, 0);
    while (!open_.empty()) {
      const NodePair pair = open_.back();
      open_.pop_back();
      if (pair.gap >= free_for_) continue;
      const auto &m = mobile_.nodes()[pair.rotating], &f = fixed_.nodes()[pair.stationary];
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
  /// Least of the motion that brings together what is so far apart, in space and in radius.
  double least(double apart, double radii_apart, double largest_radius) const noexcept {
    const double by_distance =
        std::max(apart - rounding_mm, 0.0) / (speed_.rotation * largest_radius + speed_.origin_mm);
    return radii_apart > 0 ? std::max(by_distance, radii_apart / speed_.origin_mm) : by_distance;
  }

  void push(Index mobile, Index fixed) {
    const auto &m = mobile_.nodes()[mobile], &f = fixed_.nodes()[fixed];
    const NodeBall of_mobile = ball_of(m), of_fixed = ball_of(f);
    const double from_origin = (of_fixed.centre - origin_).norm();
    const Radii fixed_radii{std::max(f.nearest - origin_off_, from_origin - of_fixed.radius),
                            std::min(f.farthest + origin_off_, from_origin + of_fixed.radius)};
    const double apart =
        (posed(X_FM_, of_mobile.centre) - of_fixed.centre).norm() - of_mobile.radius - of_fixed.radius;
    const double motion = least(apart, fixed_radii.apart_from({m.nearest, m.farthest}), m.farthest);
    if (motion < free_for_) open_.push_back({mobile, fixed, motion});
  }

  /// A ball that a triangle lies in.
  struct Around {
    Vec3 centre;
    double radius;
  };
  static Around around(const Corners3& t) noexcept {
    const Vec3 centre = (t[0] + t[1] + t[2]) / 3;
    return {centre, std::sqrt(std::max({(t[0] - centre).squaredNorm(), (t[1] - centre).squaredNorm(),
                                        (t[2] - centre).squaredNorm()}))};
  }

  Corners3 corners(const FeatureTree& tree, Index t) const {
    const auto [a, b, c] = tree.triangles()[t];
    return {tree.vertices()[a], tree.vertices()[b], tree.vertices()[c]};
  }

  void compare_leaves(const FeatureTree::Node& m, const FeatureTree::Node& f) {
    of_fixed_.clear();
    for (Index t = f.first; t < f.last; ++t) of_fixed_.push_back(around(corners(fixed_, t)));
    for (Index s = m.first; s < m.last; ++s) {
      const Corners3 own = corners(mobile_, s);
      const Corners3 placed{posed(X_FM_, own[0]), posed(X_FM_, own[1]), posed(X_FM_, own[2])};
      const Around of_mobile = around(placed);
      const double farthest = std::max({own[0].norm(), own[1].norm(), own[2].norm()});
      std::optional<Radii> of_own;
      for (Index t = f.first; t < f.last; ++t) {
        const Around& of_fixed = of_fixed_[t - f.first];
        const double apart = (of_mobile.centre - of_fixed.centre).norm() - of_mobile.radius - of_fixed.radius;
        if (least(apart, 0, farthest) >= free_for_) continue;
        if (!of_own) of_own = radii_of(own, Vec3::Zero());
        const Radii& radii = *of_own;
        const Corners3 fixed = corners(fixed_, t);
        const double radii_apart = radii.apart_from(radii_of(fixed, origin_));
        if (least(0, radii_apart, radii.high) >= free_for_) continue;
        const NearestPoints nearest = between_triangles(fixed, placed);
        const double distance = std::sqrt(nearest.squared_distance);
        const double motion = least(distance, radii_apart, radii.high);
        if (motion >= free_for_) continue;
        free_for_ = motion;
        found_ = Clearance{motion, distance, t, s, nearest.a, nearest.b};
      }
    }
  }

  const FeatureTree &fixed_, &mobile_;
  const Pose& X_FM_;
  Vec3 origin_;  ///< of M, in F
  double origin_off_;
  Speed speed_;
  double free_for_;
  std::vector<NodePair> open_;
  std::vector<Around> of_fixed_;  ///< of the leaf that is compared
  std::optional<Clearance> found_;
};

}  // namespace

std::optional<Clearance> clearance(const FeatureTree& fixed, const FeatureTree& mobile, const Pose& X_FM,
                                   double enough, const Speed& speed) {
  return ClearanceSearch(fixed, mobile, X_FM, enough, speed).run();
}

}  // namespace condyle::motion
