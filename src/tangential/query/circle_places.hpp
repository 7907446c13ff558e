#pragma once

#include "condyle/axis_frame.hpp"
#include "core/uninitialised.hpp"
#include "tangential/exact/profile.hpp"

namespace condyle::tangential {

/// A point's circle about the axis, in the axis frame: four doubles, which vectors read at once.
struct alignas(32) TurningPoint {
  double x, y, z, squared_radius;

  Vec3 at() const noexcept { return {x, y, z}; }
};

/// Box of a triangle within a cell of the profile, in 256ths of the cell, one byte each from the lowest:
/// z low, 255 - z high, rho low, 255 - rho high. A circle whose bytes are z, 255 - z, rho and 255 - rho is
/// held where none of the box's bytes exceeds its own.
using CellBox = std::uint32_t;

/// Where a circle lies in the profile.
struct CirclePlace {
  Index cell;
  CellBox at;
};

/// Circles within the grid, side by side.
struct PlacedCircles {
  core::UninitialisedVector<TurningPoint> point;
  core::UninitialisedVector<CirclePlace> place;
  core::UninitialisedVector<Index> number;  ///< Of the point, ascending.

  std::size_t size() const noexcept { return number.size(); }
};

/// The circles of those points, given in the mesh's frame, that lie within the grid: `cell_of`, with the
/// radius by `axis_radius`. The same bits on every instruction set.
void place_circles(const AxisFrame& frame, const ProfileGrid& grid, PointsView points, PlacedCircles& out);

}  // namespace condyle::tangential
