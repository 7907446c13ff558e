#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "radial/build/cell_row.hpp"
#include "radial/build/edge_functions.hpp"
#include "radial/exact/cell_dop.hpp"

/// A cube table as the vector code reads it: plain arrays, borrowed from a RadialTable.

namespace condyle::radial {

using simd::greatest_radius_code, simd::IntervalScale;

/// Greatest translation of a pose, over the distance of the nearest surface, at which floats are trusted.
inline constexpr double largest_translation = 4;

struct CubeView {
  int cells_per_side;
  int levels;                     ///< of the pyramid
  const PackedInterval* radii;    ///< of each cell
  const PackedInterval* pyramid;  ///< see DirectionPyramid
  EntryView entries;
  const std::uint8_t* nearest;  ///< code of the least squared radius of each entry's triangle, its upper half
  const EdgeFunctions* edge_functions;  ///< of each triangle
  IntervalScale scale;
  int winding_at_centre;
  float nearest_squared;   ///< no surface is nearer to the centre
  float furthest_squared;  ///< and none further away
};

/// A pose as the passes read it, about the joint centre: rotation by rows, translation, its length.
struct FloatPose {
  std::array<float, 9> rotation;
  std::array<float, 3> translation;
  float distance;
};

/// Columns of SortedPoints: its points, and the blocks of one of its levels.
struct PointColumns {
  const float *x, *y, *z;
  std::size_t size;
};
struct BlockColumns {
  const float *axis_x, *axis_y, *axis_z, *chord, *nearest, *furthest, *mean_inverse, *spread;
  std::size_t count;
};

}  // namespace condyle::radial
