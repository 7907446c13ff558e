#include "motion/search/path_clearance.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "motion/search/node_pairs.hpp"

namespace condyle::motion {
namespace {

using Corners3 = std::array<Vec3, 3>;

/// In mm. Coordinates below 10 m carry 2e-12 from one rounding; a distance goes through fewer than a hundred
/// operations on them.
constexpr double rounding_mm = 1e-9;

struct NearestPoints {
  Vec3 a, b;
  double squared_distance;
};

NearestPoints between(const Vec3& a, const Vec3& b) noexcept {
  return {a, b, (a - b).squaredNorm()};
}

Vec3 nearest_on_segment(const Vec3& p, const Vec3& a, const Vec3& b) noexcept {
  const Vec3 u = b - a;
  const double length = u.squaredNorm();
  return length > 0 ? Vec3(a + std::clamp((p - a).dot(u) / length, 0.0, 1.0) * u) : a;
}

/// The foot of p where it is inside the triangle, else the nearest point of an edge.
Vec3 nearest_on_triangle(const Vec3& p, const Corners3& t) noexcept {
  const Vec3 n = (t[1] - t[0]).cross(t[2] - t[0]);
  const double size = n.squaredNorm();
  const auto inwards = [&](const Vec3& a, const Vec3& b) { return n.cross(b - a).dot(p - a) >= 0; };
  if (size > 0 && inwards(t[0], t[1]) && inwards(t[1], t[2]) && inwards(t[2], t[0]))
    return p - ((p - t[0]).dot(n) / size) * n;
  Vec3 best = nearest_on_segment(p, t[2], t[0]);
  for (std::size_t k = 0; k < 2; ++k) {
    const Vec3 candidate = nearest_on_segment(p, t[k], t[k + 1]);
    if ((candidate - p).squaredNorm() < (best - p).squaredNorm()) best = candidate;
  }
  return best;
}

/// Of two segments. The nearest pair either lies inside both lines, where the connecting line is at a right
/// angle to both, or holds an end: ends against triangles are compared elsewhere, but an end's nearest point
/// on the other segment is cheap.
NearestPoints between_segments(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) noexcept {
  const Vec3 u = b - a, w = d - c, across = u.cross(w);
  const double size = across.squaredNorm();
  if (size > 0) {
    const double s = (c - a).cross(w).dot(across) / size, r = (c - a).cross(u).dot(across) / size;
    if (s >= 0 && s <= 1 && r >= 0 && r <= 1) return between(a + s * u, c + r * w);
  }
  NearestPoints best = between(a, nearest_on_segment(a, c, d));
  for (const NearestPoints& other :
       {between(b, nearest_on_segment(b, c, d)), between(nearest_on_segment(c, a, b), c),
        between(nearest_on_segment(d, a, b), d)})
    if (other.squared_distance < best.squared_distance) best = other;
  return best;
}

/// Of two triangles that do not intersect.
NearestPoints between_triangles(const Corners3& a, const Corners3& b) noexcept {
  NearestPoints best = between(a[0], nearest_on_triangle(a[0], b));
  const auto keep = [&](const NearestPoints& other) {
    if (other.squared_distance < best.squared_distance) best = other;
  };
  for (std::size_t i = 0; i < 3; ++i) {
    keep(between(a[i], nearest_on_triangle(a[i], b)));
    keep(between(nearest_on_triangle(b[i], a), b[i]));
    for (std::size_t k = 0; k < 3; ++k) keep(between_segments(a[i], a[(i + 1) % 3], b[k], b[(k + 1) % 3]));
  }
  return best;
}

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
