#pragma once

#include <cstddef>

#include "condyle/pose.hpp"
#include "core/uninitialised.hpp"
#include "tangential/build/cell_box.hpp"
#include "tangential/build/profile_grid.hpp"

namespace condyle::tangential {

/// A point in the axis frame, and its circle: four doubles, which vectors read at once.
struct alignas(32) CirclePoint {
  double x, y, z, squared_radius;

  Vec3 at() const noexcept { return {x, y, z}; }
};

/// Circles within the grid, one per slot.
struct LocatedCircles {
  core::UninitialisedVector<CirclePoint> point;
  core::UninitialisedVector<CircleCell> cell;
  core::UninitialisedVector<Index> number;  ///< Number of the point, ascending.

  std::size_t size() const noexcept { return number.size(); }
};

/// The circles of those points, given in the mesh's frame, that lie within the grid: `cell_of`, with the
/// radius by `axis_radius`. The same bits on every instruction set.
void locate_circles(const AxisFrame& frame, const ProfileGrid& grid, PointsView points, LocatedCircles& out);

}  // namespace condyle::tangential
