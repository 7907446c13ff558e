#include "mesh/surface_to_surface.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "mesh/triangle_intersection.hpp"

namespace condyle::mesh {
namespace {

using Node = TriangleTree::Node;

/// More than bounds of boxes and spheres round, relative to the coordinates.
constexpr double rounding = 1e-12;

struct Ball {
  Vec3 centre;
  double radius;
};

double distance_between(const Ball& a, const Ball& b) noexcept {
  return (a.centre - b.centre).norm() - a.radius - b.radius;
}

/// A triangle as placed, a ball that holds it, and a flat box that does.
struct PlacedTriangle {
  TriangleCorners corners;
  Ball ball;
  Eigen::Matrix3d axes;  ///< rows: of the box, the last at a right angle to the triangle
  Vec3 low, high;        ///< of the box, along them
  bool has_box = false;

  void place(const TriangleCorners& placed) noexcept {
    corners = placed;
    has_box = false;
    ball.centre = (placed[0] + placed[1] + placed[2]) / 3;
    double squared = 0;
    for (const Vec3& corner : placed) squared = std::max(squared, (corner - ball.centre).squaredNorm());
    ball.radius = std::sqrt(squared) * (1 + rounding) + rounding * ball.centre.norm();
  }

  /// Most triangles never need it.
  void make_box() noexcept {
    if (has_box) return;
    has_box = true;
    // Any axes at right angles hold, so one without area needs no other way.
    const Vec3 edge = corners[1] - corners[0], normal = edge.cross(corners[2] - corners[0]);
    if (normal.squaredNorm() > 0) {
      axes.row(0) = edge.normalized();
      // At right angles to rounding, however thin the triangle.
      axes.row(1) = normal.cross(edge).normalized();
      axes.row(2) = axes.row(0).cross(axes.row(1));
    } else {
      axes.setIdentity();
    }
    extent_along(axes, corners, low, high);
  }

  static void extent_along(const Eigen::Matrix3d& axes, const TriangleCorners& of, Vec3& low, Vec3& high) {
    const Vec3 a = axes * of[0], b = axes * of[1], c = axes * of[2];
    low = a.cwiseMin(b).cwiseMin(c), high = a.cwiseMax(b).cwiseMax(c);
  }

  /// No point of the other triangle is nearer to the box. Bounding balls cannot separate two triangles that face each
  /// other at a small distance.
  double distance_to(const TriangleCorners& other) noexcept {
    make_box();
    Vec3 other_low, other_high;
    extent_along(axes, other, other_low, other_high);
    const Vec3 between = (other_low - high).cwiseMax(low - other_high).cwiseMax(0.0);
    return between.norm() * (1 - rounding) - rounding * (ball.centre.norm() + other_high.norm());
  }
};

class NearestSearch {
 public:
  NearestSearch(const TriangleTree& a, const TriangleTree& b, const Pose& X_AB, double at_most_mm)
      : a_(a), b_(b), X_AB_(X_AB), best_mm_(at_most_mm) {
    const Eigen::Matrix3d R = X_AB.linear();
    to_a_size_ = R.cwiseAbs();
    origins_apart_ = X_AB.translation().norm();
    scale_error_ = 3 * (R.transpose() * R - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() + rounding;
  }

  std::optional<ClosestPoints> run() {
    if (a_.empty() || b_.empty()) return std::nullopt;
    push(0, 0);
    while (!open_.empty() && best_mm_ > 0) {
      const Pair pair = open_.back();
      open_.pop_back();
      if (pair.apart >= best_mm_) continue;
      const Node &na = a_.nodes()[pair.a], &nb = b_.nodes()[pair.b];
      if (na.is_leaf() && nb.is_leaf()) {
        compare_leaves(pair.a, pair.b);
        continue;
      }
      const std::size_t before = open_.size();
      if (nb.is_leaf() || (!na.is_leaf() && na.size() > nb.size())) {
        push(na.child, pair.b);
        push(na.child + 1, pair.b);
      } else {
        push(pair.a, nb.child);
        push(pair.a, nb.child + 1);
      }
      // Nearest first: what is nearest last on the stack.
      if (open_.size() == before + 2 && open_[before].apart < open_[before + 1].apart)
        std::swap(open_[before], open_[before + 1]);
    }
    return found_;
  }

 private:
  struct Pair {
    Index a, b;
    double apart;  ///< no points of theirs are nearer
  };

  static Vec3 vec3(const std::array<float, 4>& v) noexcept { return {v[0], v[1], v[2]}; }

  /// Distance of the boxes, B's seen along the axes of A.
  double apart(const Node& na, const Node& nb) const noexcept {
    const Vec3 centre = posed(X_AB_, vec3(nb.centre));
    const Vec3 half = to_a_size_ * vec3(nb.half);
    const Vec3 between = (centre - vec3(na.centre)).cwiseAbs() - half - vec3(na.half);
    const double scale = centre.cwiseAbs().maxCoeff() + half.maxCoeff();
    return between.cwiseMax(0.0).norm() * (1 - rounding) - rounding * scale;
  }

  /// Distance of the shells about both origins: a head and its socket lie apart by them near the roots of their
  /// trees.
  double shells_apart(const Node& na, const Node& nb) const noexcept {
    const double between =
        std::max(double{na.nearest} - double{nb.farthest}, double{nb.nearest} - double{na.farthest});
    return between - origins_apart_ -
           scale_error_ * (double{na.farthest} + double{nb.farthest} + origins_apart_);
  }

  void push(Index a, Index b) {
    const Node &na = a_.nodes()[a], &nb = b_.nodes()[b];
    if (shells_apart(na, nb) >= best_mm_) return;
    const double distance = apart(na, nb);
    if (distance < best_mm_) open_.push_back({a, b, distance});
  }

  void compare_leaves(Index leaf_a, Index leaf_b) {
    const Node &na = a_.nodes()[leaf_a], &nb = b_.nodes()[leaf_b];
    if (leaf_a != leaf_a_) {
      leaf_a_ = leaf_a;
      for (Index t = na.first; t < na.last; ++t) of_a_[t - na.first].place(a_.corners(t));
    }
    for (Index s = nb.first; s < nb.last; ++s) {
      TriangleCorners corners = b_.corners(s);
      for (Vec3& corner : corners) corner = posed(X_AB_, corner);
      PlacedTriangle of_b;
      of_b.place(corners);
      const Vec3 to_leaf = ((of_b.ball.centre - vec3(na.centre)).cwiseAbs() - vec3(na.half)).cwiseMax(0.0);
      if (to_leaf.norm() * (1 - rounding) - of_b.ball.radius >= best_mm_) continue;
      for (Index t = na.first; t < na.last; ++t) {
        PlacedTriangle& of_a = of_a_[t - na.first];
        const double least = distance_between(of_a.ball, of_b.ball);
        if (least >= best_mm_ || of_a.distance_to(of_b.corners) >= best_mm_ ||
            of_b.distance_to(of_a.corners) >= best_mm_)
          continue;
        if (least <= 0 && triangles_intersect(of_a.corners, of_b.corners)) {
          best_mm_ = 0;
          found_ = {0, a_.mesh_triangles()[t], b_.mesh_triangles()[s], of_a.ball.centre, of_b.ball.centre};
          return;
        }
        const NearestPoints nearest = between_triangles(of_a.corners, of_b.corners);
        const double distance = std::sqrt(nearest.squared_distance);
        if (distance >= best_mm_) continue;
        best_mm_ = distance;
        found_ = {distance, a_.mesh_triangles()[t], b_.mesh_triangles()[s], nearest.a, nearest.b};
      }
    }
  }

  const TriangleTree &a_, &b_;
  const Pose& X_AB_;
  Eigen::Matrix3d to_a_size_;
  double origins_apart_;
  /// Relative error of distances from B's origin if the pose is not quite a rotation: |R p|^2 is |p|^2 and p.(R^T R - 1)p, at
  /// most three times the largest entry.
  double scale_error_;
  std::vector<Pair> open_;
  Index leaf_a_ = no_index;
  std::array<PlacedTriangle, TriangleTree::leaf_triangles> of_a_;  ///< of that leaf
  double best_mm_;
  std::optional<ClosestPoints> found_;
};

}  // namespace

std::optional<ClosestPoints> closest_points(const TriangleTree& a, const TriangleTree& b, const Pose& X_AB,
                                            double at_most_mm) {
  return NearestSearch(a, b, X_AB, at_most_mm).run();
}

}  // namespace condyle::mesh
