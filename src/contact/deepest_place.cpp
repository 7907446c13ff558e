#include "contact/deepest_place.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <queue>
#include <span>
#include <utility>
#include <vector>

#include "core/ordered_sums.hpp"
#include "mesh/surface_distance.hpp"
#include "mesh/triangle_distance.hpp"
#include "mesh/vertical_ray.hpp"

namespace condyle::contact {
namespace {

using Node = mesh::TriangleTree::Node;
using CornerPoints = std::array<Vec3, 3>;

/// A bound that exceeds a depth by this share of the coordinates does so by rounding.
constexpr double depth_rounding = 1e-13;

/// Bounds that were dropped, and depths, are off by less than so many of these.
constexpr double bound_rounding = 16;

/// Points that are looked at first.
constexpr std::size_t most_considered = 64;

/// Every so often a part is halved, whatever else would cut it: its size then goes to zero.
constexpr int cuts_per_halving = 4;

/// The search opens a node without a look at its middle if the node's radius is larger than this many best depths and than this share of the
/// target's least half.
constexpr double large_depths = 1.5, large_share = 0.1;

/// Bounds of nodes are in single precision, and cover what they hold after they are posed.
constexpr double node_slack = 1 + 1e-5;

/// SurfacePart of the surface S that may be deepest: what a node owns, or a convex piece of a triangle.
struct SurfacePart {
  double bound;  ///< no point of it is deeper
  Index node = no_index, triangle = no_index;
  std::vector<Vec3> corners = {};  ///< of a piece, in the frame of T
  Index near = no_index;           ///< a triangle of T that was nearest to what it is a part of
  Index through = no_index;        ///< one through which it may get inside, if its middle is outside
  int cuts = 0;
  bool is_inside = false;   ///< every point of it; a place that is taken for it is looked at again
  bool is_sounded = false;  ///< the depth at the middle of the node is in its bound

  friend bool operator<(const SurfacePart& a, const SurfacePart& b) noexcept { return a.bound < b.bound; }
};

/// A point against the target.
struct Sounding {
  double depth;   ///< below 0 outside, if that was asked
  Index nearest;  ///< place of the triangle of T that is nearest
};

double distance_to(const Vec3& p, const CornerPoints& t) {
  return core::ordered_norm(mesh::nearest_on_triangle(p, t) - p);
}

/// A point inside a surface is no farther from it than from a face of its box.
double least_half_of(const Node& root) {
  return node_slack * std::min({root.half[0], root.half[1], root.half[2]});
}

Vec3 normal_of_corners(const CornerPoints& t) {
  return (t[1] - t[0]).cross(t[2] - t[0]).normalized();
}

Vec3 middle_of_corners(const std::vector<Vec3>& corners) {
  Vec3 sum = Vec3::Zero();
  for (const Vec3& p : corners) sum += p;
  return sum / static_cast<double>(corners.size());
}

/// Least and greatest place of points along an axis.
template <class Points>
std::pair<double, double> extent_along(const Vec3& axis, const Points& points) {
  double low = points[0].dot(axis), high = low;
  for (const Vec3& p : points) low = std::min(low, p.dot(axis)), high = std::max(high, p.dot(axis));
  return {low, high};
}

double radius_about(const std::vector<Vec3>& corners, const Vec3& middle) {
  double radius = 0;
  for (const Vec3& p : corners) radius = std::max(radius, core::ordered_norm(p - middle));
  return radius;
}

/// A linear function n.p - d.
struct LinearFunction {
  Vec3 n;
  double d;
  double operator()(const Vec3& p) const noexcept { return n.dot(p) - d; }
};

/// Above 0 on the outer side of a triangle.
LinearFunction plane_of(const CornerPoints& t) {
  const Vec3 n = normal_of_corners(t);
  return {n, n.dot(t[0])};
}

class DepthSearch {
 public:
  DepthSearch(const mesh::TriangleTree& target, const mesh::TriangleTree& surface, const Pose& X_TS,
              Reaching reaching, double deeper_than, std::size_t most_parts)
      : target_(target),
        surface_(surface),
        X_TS_(X_TS),
        distances_(target),
        reaching_(std::move(reaching.places)),
        most_parts_(most_parts) {
    meeting_before_.push_back(0);
    for (const char meets : reaching.meets) meeting_before_.push_back(meeting_before_.back() + (meets != 0));
    double size = X_TS.translation().cwiseAbs().maxCoeff();
    for (const auto* tree : {&target, &surface}) {
      const Node& root = tree->nodes().front();
      for (std::size_t k = 0; k < 3; ++k)
        size = std::max(size, static_cast<double>(std::abs(root.centre[k]) + root.half[k]));
    }
    tolerance_ = depth_rounding * size;
    best_.depth_mm = deeper_than;
  }

  DepthSearched run() {
    consider_some();
    push_node(0, {.bound = least_half_of(target_.nodes().front())});
    while (!open_.empty() && open_.top().bound > best_.depth_mm + tolerance_ && parts_ < most_parts_) {
      SurfacePart part = open_.top();
      open_.pop();
      if (part.node == no_index)
        cut(part);
      else if (part.is_sounded)
        open_node(part);
      else
        sound_node(std::move(part));
    }
    const double bound = open_.empty() ? 0 : open_.top().bound;
    DepthSearched found{.bound_mm = std::max(bound, best_.depth_mm + bound_rounding * tolerance_)};
    if (is_found_) found.deepest = best_;
    return found;
  }

 private:
  /// The middle of what reaches so far from it; `near` is a triangle to begin with. On which side it is matters only if something there
  /// could be deepest.
  Sounding sound(const Vec3& p, double radius, bool is_known_inside, Index near) {
    ++parts_;
    if (near != no_index) nearest_ = near;
    const double distance = distances_(p, nearest_, best_.depth_mm - radius);
    const bool matters = !is_known_inside && distance + radius > best_.depth_mm;
    return {matters && !is_inside(p) ? -distance : distance, nearest_};
  }

  bool is_inside(const Vec3& p) const {
    return mesh::winding_number(
               target_, p, [](const Node& node) { return node; },
               [&](Index t) { return target_.corners(t); }) > 0;
  }

  /// How far p is at least from T, by the box of all of it: 0 within. Most of a surface that meets T is known by it to be outside.
  double least_outside(const Vec3& p) const noexcept {
    const Node& root = target_.nodes().front();
    Vec3 off = Vec3::Zero();
    for (int k = 0; k < 3; ++k)
      off[k] = std::max(0.0, std::abs(p[k] - root.centre[k]) - node_slack * root.half[k]);
    return core::ordered_norm(off) / node_slack;
  }

  /// False of a place that would be deepest and is outside, though it was taken for inside.
  bool consider(const Vec3& p, Index triangle, const Sounding& at) {
    // No more than rounding is none: the middle of a triangle need not lie on it to the last bit.
    if (!(at.depth > std::max(best_.depth_mm, tolerance_))) return true;
    if (!is_inside(p)) return false;
    is_found_ = true;
    best_.depth_mm = at.depth;
    best_.place = p;
    best_.exit = mesh::nearest_on_triangle(p, target_.corners(at.nearest));
    best_.triangle = surface_.mesh_triangles()[triangle];
    best_.target_triangle = target_.mesh_triangles()[at.nearest];
    return true;
  }

  /// Points of the surface to compare bounds with: if all of it is about as deep, bounds alone would not come to one.
  void consider_some() {
    const std::size_t step = reaching_.size() / most_considered + 1;
    for (std::size_t i = 0; i < reaching_.size(); i += step) {
      const Vec3 p = posed(X_TS_, surface_.corners(reaching_[i])[0]);
      if (least_outside(p) > 0) continue;
      consider(p, reaching_[i], sound(p, 0, true, no_index));
    }
  }

  /// The triangles of a node that reach into T, by their number among those that do.
  struct ReachingOfNode {
    std::size_t first, last;
  };
  ReachingOfNode reaching_of(const Node& node) const {
    const auto first = std::lower_bound(reaching_.begin(), reaching_.end(), node.first);
    const auto last = std::lower_bound(first, reaching_.end(), node.last);
    return {static_cast<std::size_t>(first - reaching_.begin()),
            static_cast<std::size_t>(last - reaching_.begin())};
  }

  /// Whether none of these meets T.
  bool are_inside(const ReachingOfNode& range) const {
    return meeting_before_[range.first] == meeting_before_[range.last];
  }

  /// About what a node holds, in T.
  struct Ball {
    Vec3 centre;
    double radius;
  };
  Ball ball_around(const Node& node) const {
    return {posed(X_TS_, Vec3(node.centre[0], node.centre[1], node.centre[2])),
            node_slack * core::ordered_norm(Vec3(node.half[0], node.half[1], node.half[2]))};
  }

  /// With the bound of what it is a part of, or by the triangle that was near there: cheaper than the nearest.
  void push_node(Index number, const SurfacePart& parent) {
    const Node& node = surface_.nodes()[number];
    const ReachingOfNode reaching = reaching_of(node);
    if (reaching.first == reaching.last) return;
    const auto [centre, radius] = ball_around(node);
    if (const double off = least_outside(centre); off > 0 && !(radius - off > best_.depth_mm)) return;
    SurfacePart part{.bound = parent.bound,
                     .node = number,
                     .near = parent.near,
                     .is_inside = parent.is_inside || are_inside(reaching)};
    if (part.near != no_index) {
      if (!(distance_to(centre, target_.corners(part.near)) + radius > best_.depth_mm)) return;
      part.bound = std::min(part.bound, farthest_of_box(part.near, node, centre));
      if (!(part.bound > best_.depth_mm)) return;
    }
    open_.push(std::move(part));
  }

  /// Only once no other bound is larger: most nodes are never looked at.
  void sound_node(SurfacePart part) {
    const Node& node = surface_.nodes()[part.node];
    const auto [centre, radius] = ball_around(node);
    if (!node.is_leaf() && radius > std::max(large_depths * best_.depth_mm,
                                             large_share * least_half_of(target_.nodes().front())))
      return open_node(part);
    const Sounding at = sound(centre, radius, part.is_inside, part.near);
    part.is_sounded = true;
    part.is_inside = part.is_inside || at.depth > radius;
    part.bound = std::min(part.bound, at.depth + radius);
    if (at.nearest != part.near) part.bound = std::min(part.bound, farthest_of_box(at.nearest, node, centre));
    part.near = at.nearest;
    if (part.bound > best_.depth_mm) open_.push(std::move(part));
  }

  void open_node(const SurfacePart& part) {
    const Node& node = surface_.nodes()[part.node];
    if (!node.is_leaf()) {
      push_node(node.child, part);
      push_node(node.child + 1, part);
      return;
    }
    const ReachingOfNode reaching = reaching_of(node);
    for (std::size_t i = reaching.first; i < reaching.last; ++i) {
      const Index t = reaching_[i];
      const CornerPoints own = surface_.corners(t);
      push_piece({.bound = part.bound,
                  .triangle = t,
                  .corners = {posed(X_TS_, own[0]), posed(X_TS_, own[1]), posed(X_TS_, own[2])},
                  .near = part.near,
                  .is_inside = part.is_inside || are_inside({i, i + 1})});
    }
  }

  /// The largest distance of a corner from one triangle of T: no point of the piece has a larger depth.
  double farthest_from(Index triangle, const SurfacePart& piece) const {
    const CornerPoints corners = target_.corners(triangle);
    double farthest = 0;
    for (const Vec3& p : piece.corners) farthest = std::max(farthest, distance_to(p, corners));
    return farthest;
  }

  /// The same of the box of a node, which has this centre in T. Of a flat box beside a face it is little more than the depth, where depth and
  /// radius are as much more as the box is wide.
  double farthest_of_box(Index triangle, const Node& node, const Vec3& centre) const {
    const CornerPoints corners = target_.corners(triangle);
    const auto half = [&](int k) -> Vec3 {
      return node_slack * node.half[static_cast<std::size_t>(k)] * X_TS_.linear().col(k);
    };
    const Vec3 x = half(0), y = half(1), z = half(2);
    double farthest = 0;
    for (const double s : {-1., 1.})
      for (const Vec3& p : {Vec3(x + y), Vec3(x - y), Vec3(y - x), Vec3(-x - y)})
        farthest = std::max(farthest, distance_to(centre + p + s * z, corners));
    return farthest;
  }

  /// With its bound, unless no point of it can be deepest.
  void push_piece(SurfacePart part) {
    part.bound = std::min(part.bound, farthest_from(part.near, part));
    if (!(part.bound > best_.depth_mm + tolerance_)) return;
    const Vec3 middle = middle_of_corners(part.corners);
    const double radius = radius_about(part.corners, middle);
    Sounding at = sound(middle, radius, part.is_inside, part.near);
    if (!consider(middle, part.triangle, at)) part.is_inside = false, at.depth = -at.depth;
    part.is_inside = part.is_inside || at.depth > radius;
    part.near = at.nearest;
    part.bound = std::min({part.bound, at.depth + radius, farthest_from(at.nearest, part)});
    if (!(part.bound > best_.depth_mm + tolerance_)) return;
    part.through = no_index;
    if (at.depth < -tolerance_) {
      part.through = way_in(part);
      if (part.through == no_index) return;
    }
    open_.push(std::move(part));
  }

  /// A triangle of T through which a piece whose middle is outside may get inside: which it may meet, and has a corner of it on its inner
  /// side. Without one all of the piece is outside, though it may touch. Pieces that touch, or end just outside of a thin overlap, would
  /// be cut until they are as small as the depth.
  Index way_in(const SurfacePart& part) const {
    Vec3 low = part.corners[0], high = low;
    for (const Vec3& p : part.corners) low = low.cwiseMin(p), high = high.cwiseMax(p);
    const Vec3 across = (part.corners[1] - part.corners[0]).cross(part.corners[2] - part.corners[0]);
    // Not one plane: corners of a piece that was cut may lie so near each other that no axis is across it.
    const std::pair<double, double> extent = extent_along(across, part.corners);
    const auto may_meet = [&](const Node& node) {
      double middle = 0, reach = 0;
      for (int k = 0; k < 3; ++k) {
        const double centre = node.centre[k], half = node_slack * node.half[k] + tolerance_;
        if (centre - half > high[k] || centre + half < low[k]) return false;
        middle += across[k] * centre;
        reach += std::abs(across[k]) * half;
      }
      return middle - reach <= extent.second && middle + reach >= extent.first;
    };
    std::vector<Index> open = {0};
    while (!open.empty()) {
      const Node& node = target_.nodes()[open.back()];
      open.pop_back();
      if (!may_meet(node)) continue;
      if (!node.is_leaf()) {
        open.insert(open.end(), {node.child, node.child + 1});
        continue;
      }
      for (Index t = node.first; t < node.last; ++t) {
        const CornerPoints corners = target_.corners(t);
        const LinearFunction above = plane_of(corners);
        if (std::any_of(part.corners.begin(), part.corners.end(),
                        [&](const Vec3& p) { return above(p) < -tolerance_; }) &&
            !are_separated(part.corners, across, corners, above.n))
          return t;
      }
    }
    return no_index;
  }

  /// Whether a plane at a right angle to `across`, or to that and an edge of a piece, or in which an edge of a triangle and its normal n lie,
  /// keeps them apart.
  bool are_separated(const std::vector<Vec3>& piece, const Vec3& across, const CornerPoints& t,
                     const Vec3& n) const {
    const auto apart_along = [&](const Vec3& axis) {
      const auto [piece_low, piece_high] = extent_along(axis, piece);
      const auto [low, high] = extent_along(axis, t);
      return std::max(low - piece_high, piece_low - high) > tolerance_ * core::ordered_norm(axis);
    };
    if (apart_along(across)) return true;
    for (std::size_t k = 0; k < piece.size(); ++k)
      if (apart_along((piece[(k + 1) % piece.size()] - piece[k]).cross(across))) return true;
    for (std::size_t k = 0; k < 3; ++k)
      if (apart_along((t[(k + 1) % 3] - t[k]).cross(n))) return true;
    return false;
  }

  /// Cuts off what is outside, where the piece may get in; else where its bound comes from: the corner that is farthest from the triangle that is
  /// nearest to the middle.
  void cut(const SurfacePart& part) {
    const Vec3 middle = middle_of_corners(part.corners);
    const CornerPoints near = target_.corners(part.near);
    const Vec3 far = *std::max_element(
        part.corners.begin(), part.corners.end(),
        [&](const Vec3& a, const Vec3& b) { return distance_to(a, near) < distance_to(b, near); });
    const Sounding at_far = sound(far, 0, part.is_inside, part.near);
    consider(far, part.triangle, at_far);
    if (part.cuts % cuts_per_halving != cuts_per_halving - 1) {
      if (part.through != no_index && split(part, plane_of(target_.corners(part.through)))) return;
      if (const auto edge = edge_between(near, middle, far); edge && split(part, *edge)) return;
      const LinearFunction of_near = plane_of(near), of_other = plane_of(target_.corners(at_far.nearest));
      if (at_far.depth < 0 && split(part, of_other)) return;
      // Depths below two faces are equal on a plane.
      if (split(part, {of_other.n - of_near.n, of_other.d - of_near.d})) return;
    }
    halve(part);
  }

  /// Through an edge of the triangle, at a right angle to it: between the middle, which is over it, and a point that is not.
  static std::optional<LinearFunction> edge_between(const CornerPoints& t, const Vec3& middle,
                                                    const Vec3& far) {
    const Vec3 n = normal_of_corners(t);
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 outwards = (t[(k + 1) % 3] - t[k]).cross(n).normalized();
      const LinearFunction beyond{outwards, outwards.dot(t[k])};
      if (beyond(middle) < 0 && beyond(far) > 0) return beyond;
    }
    return std::nullopt;
  }

  /// False if it leaves one side empty, to rounding.
  bool split(const SurfacePart& part, const LinearFunction& by) {
    double low = 0, high = 0;
    std::vector<double> values;
    for (const Vec3& p : part.corners) {
      values.push_back(by(p));
      low = std::min(low, values.back()), high = std::max(high, values.back());
    }
    if (!(low < -tolerance_ && high > tolerance_)) return false;
    SurfacePart below = part, above = part;
    below.corners.clear(), above.corners.clear();
    for (std::size_t k = 0; k < values.size(); ++k) {
      const std::size_t next = (k + 1) % values.size();
      if (values[k] <= 0) below.corners.push_back(part.corners[k]);
      if (values[k] >= 0) above.corners.push_back(part.corners[k]);
      if ((values[k] < 0 && values[next] > 0) || (values[k] > 0 && values[next] < 0)) {
        const double share = values[k] / (values[k] - values[next]);
        const Vec3 between = part.corners[k] + share * (part.corners[next] - part.corners[k]);
        below.corners.push_back(between), above.corners.push_back(between);
      }
    }
    ++below.cuts, ++above.cuts;
    push_piece(std::move(below)), push_piece(std::move(above));
    return true;
  }

  /// Across its longest direction.
  void halve(const SurfacePart& part) {
    const Vec3 middle = middle_of_corners(part.corners);
    const Vec3 end =
        *std::max_element(part.corners.begin(), part.corners.end(), [&](const Vec3& a, const Vec3& b) {
          return (a - middle).squaredNorm() < (b - middle).squaredNorm();
        });
    const double size = core::ordered_norm(end - middle);
    if (!(size > tolerance_)) return;  // a point, and it was considered
    const Vec3 along = (end - middle) / size;
    split(part, {along, along.dot(middle)});
  }

  const mesh::TriangleTree &target_, &surface_;
  const Pose& X_TS_;
  mesh::DistancesToSurface distances_;
  std::vector<Index> reaching_;              ///< places of triangles of S, ascending
  std::vector<std::size_t> meeting_before_;  ///< how many of those before each meet T, and of all
  std::size_t most_parts_, parts_ = 0;
  double tolerance_ = 0;
  Index nearest_ = no_index;
  std::priority_queue<SurfacePart> open_;
  bool is_found_ = false;
  DeepestPlace best_{};
};

}  // namespace

DepthSearched deepest_place(const mesh::TriangleTree& target, const mesh::TriangleTree& surface,
                            const Pose& X_TS, std::optional<Reaching> reaching, double deeper_than_mm,
                            std::size_t most_parts) {
  if (target.empty() || surface.empty()) return {};
  if (!reaching) {
    const std::size_t all = surface.triangles().size();
    reaching = {std::vector<Index>(all), std::vector<char>(all, true)};
    std::iota(reaching->places.begin(), reaching->places.end(), Index{0});
  }
  return DepthSearch(target, surface, X_TS, std::move(*reaching), deeper_than_mm, most_parts).run();
}

}  // namespace condyle::contact
