#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "condyle/pose.hpp"
#include "core/predicates.hpp"
#include "tangential/build/profile_grid.hpp"

/// Conservative rasterisation of triangles that rotate about z, in the profile.

namespace condyle::tangential {

/// Interval of distances from the axis.
struct RadiusInterval {
  double low, high;
};

/// A convex planar figure, or its part between two heights: a triangle's three corners and one more for each cut,
/// with two in reserve.
struct ProfilePolygon {
  std::array<Vec3, 7> corner;
  int count = 0;

  void push_back(const Vec3& p) noexcept { corner[static_cast<std::size_t>(count++)] = p; }
};

/// The part of a convex polygon with low <= z <= high. Cut points err by at most 24u of the largest |x|, |y|
/// (12u for each of two cuts of one edge).
ProfilePolygon clipped_to_heights(const ProfilePolygon& polygon, double low, double high) noexcept;

/// Radii of the circles about z that meet the polygon, widened so that no exact answer lies outside: the
/// largest is at a corner, **the smallest may be inside an edge or the face** (0 if the axis pierces it).
///
/// M being the largest |x|, |y|: corners carry 24u M, the foot of the axis on an edge 8u M, a circle's own
/// computed radius 3u * sqrt(2) M. A figure of which no edge has a certain sense about the axis, and which is
/// pierced nevertheless, is a sliver at least M long with an area below 7/2 * 128u M^2: its boundary passes
/// the axis within 896u M. 1024u M covers all.
RadiusInterval radius_interval(const ProfilePolygon& polygon) noexcept;

/// Calls visit(row, first_column, last_column) for the cells which a triangle meets as it rotates about z:
/// at most one run per row, rows ascending. Complete: if any circle (rho, z) within the grid meets the closed
/// triangle, exactly, then its `cell_of` is among them, with rho computed by `axis_radius`. A few cells may
/// be among them that it misses by rounding. What lies beyond the grid is left out.
template <class Visit>
void for_each_profile_run(const ProfileGrid& grid, const Vec3& a, const Vec3& b, const Vec3& c,
                          Visit&& visit) {
  ProfilePolygon polygon;
  polygon.push_back(a), polygon.push_back(b), polygon.push_back(c);
  double z_low = polygon.corner[0].z(), z_high = z_low;
  for (int k = 1; k < polygon.count; ++k) {
    const double z = polygon.corner[static_cast<std::size_t>(k)].z();
    z_low = std::min(z_low, z), z_high = std::max(z_high, z);
  }
  if (!(z_high >= grid.z_min && z_low <= grid.z_max)) return;
  const Index first = grid.row_at(z_low), last = grid.row_at(z_high);
  // Heights that fall in row r: a difference, the size of a cell, its reciprocal, a product with it and the
  // product below, each rounded once, leave it by less than 8u of the largest height.
  const double slack = 8 * core::rounding_unit * (std::abs(grid.z_min) + std::abs(grid.z_max));
  const bool reaches_beyond = z_low < grid.z_min || z_high > grid.z_max;
  for (Index row = first; row <= last; ++row) {
    RadiusInterval radii;
    if (first == last && !reaches_beyond) {
      radii = radius_interval(polygon);
    } else {
      const double low = grid.z_min + row * grid.z_cell - slack;
      const double high = row + 1 == grid.rows ? grid.z_max : grid.z_min + (row + 1) * grid.z_cell + slack;
      const ProfilePolygon strip = clipped_to_heights(polygon, low, high);
      if (strip.count == 0) continue;
      radii = radius_interval(strip);
    }
    if (!(radii.high >= grid.rho_min && radii.low <= grid.rho_max)) continue;
    visit(row, grid.column_at(radii.low), grid.column_at(radii.high));
  }
}

}  // namespace condyle::tangential
