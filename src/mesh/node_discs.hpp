#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "mesh/triangle_tree.hpp"

namespace condyle::mesh {

/// Bounds of a tree's nodes beside their boxes: a slab across the mean normal of the node's triangles, and a ball.
///
///     p  .          The box of triangles of size h that lie obliquely is up to h nearer to a distant p than they are, and p is as
///         .         near as that to a number of boxes that grows with 1 / h. The slab is h^2 times the curvature nearer, and that
///       _____       number stays what it is.
///      (__+__)
///
/// Linear.
class NodeDiscs {
 public:
  /// The tree must outlive it and keep its vertices.
  explicit NodeDiscs(const TriangleTree& tree);

  /// No point of the node's triangles is nearer to p, whatever a distance to one of them is rounded by.
  double squared_distance(const Vec3& p, Index node) const noexcept {
    const Disc& disc = discs_[node];
    const Vec3 to_p = p - centre(node);
    const double along = disc.direction().dot(to_p), radius = double{disc.radius};
    const double beyond = std::max(0.0, std::max(along - double{disc.high}, double{disc.low} - along));
    const double squared_across = to_p.squaredNorm() - along * along * more_than_square;
    double squared = beyond * beyond;
    if (squared_across > radius * radius) {
      const double across = std::sqrt(squared_across) - radius;
      squared += across * across;
    }
    return squared * (1 - 0x1p-40);
  }

 private:
  /// A unit vector in single precision is made shorter by this, so that none is longer than 1; 1 over its square is at most the second.
  static constexpr double shorter = 0x1p-22, more_than_square = 1 + 0x1p-20;

  /// About the centre c of the box: low <= normal.(q - c) <= high and |q - c| <= radius for every q of the triangles. The normal is
  /// 0, or a little shorter than 1.
  struct alignas(32) Disc {
    std::array<float, 3> normal;
    float low, high, radius;

    Vec3 direction() const noexcept { return {double{normal[0]}, double{normal[1]}, double{normal[2]}}; }
  };

  Vec3 centre(Index node) const noexcept {
    const auto& c = tree_.nodes()[node].centre;
    return {double{c[0]}, double{c[1]}, double{c[2]}};
  }
  static Vec3 direction_of(const Vec3& normal);
  void bound_leaf(Index node);
  void bound_children(Index node);
  void set_bounds(Index node, double low, double high, double radius);

  const TriangleTree& tree_;
  std::vector<Disc> discs_;
};

}  // namespace condyle::mesh
