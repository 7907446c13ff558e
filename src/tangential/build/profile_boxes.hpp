#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "condyle/mesh.hpp"
#include "condyle/pose.hpp"
#include "core/uninitialised.hpp"

/// Sorts triangles into rings: each in a box of radii and heights, in single precision, rounded outwards.

namespace condyle::tangential {

/// A vertex in the axis frame, each value rounded to the nearest float, in units of the boxes.
struct alignas(16) ProfileVertex {
  float x, y, rho, z;
};

/// A vertex in the axis frame: four doubles, which vectors read at once.
struct alignas(32) AxisVertex {
  Vec3 at;
  double unused;
};

/// Vertices of a mesh in the frame of an axis.
struct AxisVertices {
  core::UninitialisedVector<AxisVertex> exact;
  core::UninitialisedVector<ProfileVertex> rounded;
  /// Eighth of a turn in which the vertex lies, as a bit, counter-clockwise from +x; none if it is near a
  /// border (FreeDirections::clearance).
  core::UninitialisedVector<std::uint8_t> sector;
  /// Units of the rounded values in a millimetre: a power of two, so that no square of a float overflows and
  /// none that matters underflows.
  double units_per_mm = 1;
};

AxisVertices vertices_in_axis_frame(PointsView vertices, const AxisFrame& frame);

/// One float per triangle and side of its box, in units: complete, for every circle (rho, z) that meets the
/// closed triangle lies in it, with rho computed by `axis_radius`. Filled up to a multiple of 16 with the
/// last one.
struct ProfileBoxes {
  core::UninitialisedVector<float> rho_low, rho_high, z_low, z_high;
  /// The box around all; empty (low > high) where there is no triangle.
  float rho_min, rho_max, z_min, z_max;
  /// At least every |x| and |y| of the triangles, in units.
  float scale;
  /// Triangles that may have corners in several sectors or in none, ascending: where what a triangle takes in
  /// x and y is well within one sector, its corners are.
  core::UninitialisedVector<Index> across_sectors;
};

ProfileBoxes profile_boxes(std::span<const ProfileVertex> vertices, std::span<const Triangle> triangles);

}  // namespace condyle::tangential
