#pragma once

#include <array>
#include <vector>

#include "mesh/triangle_intersection.hpp"
#include "mesh/triangle_tree.hpp"

namespace condyle::mesh {

/// Boxes of a tree's nodes along their longest edge and their mean normal. Of slender triangles that lie side by side, upright boxes
/// overlap with as many others as fit into their length, and these with their neighbours.
///
///     ___________
///    |   / /    .|     / /
///    |  / /    . |    / /      upright, oriented
///    | / /    .  |   / /
///    |/_/____.___|  /_/
///
/// Linear.
class OrientedBoxes {
 public:
  OrientedBoxes() = default;
  explicit OrientedBoxes(const TriangleTree& tree);

  bool empty() const noexcept { return boxes_.empty(); }
  /// Whether they are certain to have no point in common: along one of their six axes.
  bool apart(Index a, Index b) const noexcept;

 private:
  /// Every point of the triangles is the centre plus at most half[k] of each axis. Axes are rounded to single precision, and halves
  /// wider by more than that.
  struct Box {
    Vec3 centre;
    std::array<std::array<float, 3>, 3> axes;
    std::array<float, 3> half;

    Vec3 axis(std::size_t k) const noexcept {
      return {double{axes[k][0]}, double{axes[k][1]}, double{axes[k][2]}};
    }
  };

  static void set_axes(Box& box, const Vec3& longest, const Vec3& normal);
  static void set_bounds(Box& box, const Vec3& centre, const Vec3& low, const Vec3& high);

  std::vector<Box> boxes_;
};

/// Whether more than one in eight triangles, of some thousand spread over the tree, is longer than 16 times its height: oriented
/// boxes of others cost more than they save.
bool are_often_slender(const TriangleTree& tree);

/// Bounds of a triangle across its longest edge, in its plane.
class TriangleStrip {
 public:
  explicit TriangleStrip(const TriangleCorners& triangle);
  /// Whether another triangle is certain to lie beside it.
  bool apart(const TriangleCorners& other) const noexcept;

 private:
  struct Interval {
    double low, high;
  };
  /// Wider than the triangle by the rounding of its sums.
  Interval of(const TriangleCorners& triangle) const noexcept;

  Vec3 origin_, across_;  ///< of length 1, or 0: whatever it is rounded to, bounds along it are bounds
  Interval own_;
};

}  // namespace condyle::mesh
