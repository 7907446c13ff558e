#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "radial/build/cell_row.hpp"
#include "radial/build/cube_passes.hpp"
#include "radial/build/edge_functions.hpp"
#include "radial/exact/cell_dop.hpp"

/// A cube table as the vector code reads it: plain arrays, borrowed from a RadialTable.

namespace condyle::radial {

/// Greatest translation of a pose, over the distance of the nearest surface, at which floats are trusted.
inline constexpr double largest_translation = 4;

/// How far the surface may have moved since its radii were found: a point of it by so many mm, and seen from the centre by a
/// cap of directions with this sine, for which a level of the pyramid has slack. All 0 where it has not moved.
struct Drift {
  float mm = 0, sine = 0;
  int level = 0;
};

struct CubeView {
  int cells_per_side;
  int levels;                     ///< of the pyramid
  const PackedInterval* radii;    ///< of each cell
  const PackedInterval* pyramid;  ///< see DirectionPyramid
  EntryView entries;
  const std::uint8_t* nearest;  ///< code of the least squared radius of each entry's triangle, its upper half
  const EdgeFunctions*
      edge_functions;  ///< of each triangle; null: measured for each pair of a point and a triangle
  MeshView mesh;       ///< for that
  Drift drift;
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
