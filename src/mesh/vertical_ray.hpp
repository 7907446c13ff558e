#pragma once

#include <cmath>
#include <vector>

#include "core/predicates.hpp"
#include "mesh/triangle_intersection.hpp"
#include "mesh/triangle_tree.hpp"

/// Crossings of a vertical line, for winding numbers. A line through an edge or a vertex is decided as that
/// through p + e x + e^2 y for an infinitely small e > 0: one shift for all triangles, so neighbours never
/// disagree, and a vertical triangle is never crossed. Exact for the doubles given.

namespace condyle::mesh {

/// On which side of the edge a b, seen along z, the shifted point p + e x + e^2 y lies. Zero for a vertical
/// edge only.
///
/// orientation_2d = (b_x - a_x)(p_y - a_y) - (b_y - a_y)(p_x - a_x): its derivative by p_x is a_y - b_y, by
/// p_y b_x - a_x.
inline core::Sign side_of_shifted(const Vec3& a, const Vec3& b, const Vec3& p) noexcept {
  const core::Sign side = core::orientation_2d(a.x(), a.y(), b.x(), b.y(), p.x(), p.y());
  if (side != core::Sign::zero) return side;
  if (a.y() != b.y()) return a.y() > b.y() ? core::Sign::positive : core::Sign::negative;
  if (a.x() != b.x()) return b.x() > a.x() ? core::Sign::positive : core::Sign::negative;
  return core::Sign::zero;
}

/// +1 where the vertical line through the shifted point crosses the triangle and its normal points up, -1
/// where down, 0 if they do not meet.
inline int vertical_crossing(const TriangleCorners& t, const Vec3& p) noexcept {
  const core::Sign first = side_of_shifted(t[0], t[1], p);
  if (first == core::Sign::zero || side_of_shifted(t[1], t[2], p) != first ||
      side_of_shifted(t[2], t[0], p) != first) {
    return 0;
  }
  return static_cast<int>(first);
}

/// The same for the ray upwards from a point that is not on the triangle. Summed over a closed mesh: the
/// winding number.
inline int crossing_above(const TriangleCorners& t, const Vec3& p) noexcept {
  const int sense = vertical_crossing(t, p);
  // Facing up, the triangle is above p where p is on its back.
  return sense * static_cast<int>(core::orientation(t[0], t[1], t[2], p)) < 0 ? sense : 0;
}

/// Winding number of the closed mesh of a tree about a point that is not on it. `box_of` bounds a node and `corners_of` gives the
/// corners of a triangle, both in the frame of the point.
template <class BoxOf, class CornersOf>
int winding_number(const TriangleTree& tree, const Vec3& p, const BoxOf& box_of,
                   const CornersOf& corners_of) {
  int winding = 0;
  std::vector<Index> open = {0};
  while (!open.empty()) {
    const Index i = open.back();
    open.pop_back();
    const TriangleTree::Node& node = tree.nodes()[i];
    const auto box = box_of(node);
    const auto beyond = [&](int axis) { return std::abs(p[axis] - box.centre[axis]) > box.half[axis]; };
    if (beyond(0) || beyond(1) || p.z() - box.centre[2] > box.half[2]) continue;
    if (!node.is_leaf()) {
      open.push_back(node.child);
      open.push_back(node.child + 1);
      continue;
    }
    for (Index t = node.first; t < node.last; ++t) winding += crossing_above(corners_of(t), p);
  }
  return winding;
}

}  // namespace condyle::mesh
