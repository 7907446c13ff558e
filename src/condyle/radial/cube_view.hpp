#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "condyle/core/vec3.hpp"
#include "condyle/radial/radius_scale.hpp"

/// A cube table as the vector code reads it: plain arrays, borrowed from a RadialTable.

namespace condyle {

/// Cells are cut into so many parts each way; boxes of triangles within a cell are rounded outwards to them.
inline constexpr int parts_per_cell = 256;

/// Widening of triangles in the lists of a cube map, in units of a face's coordinate (which spans [-1, 1]).
/// Vector code places a point by floats, which errs by at most
///
///     23 u + 42 u |t| / r,   u = 2^-24, t the pose's translation, r the radius of the nearest surface
///
/// (`largest_translation` keeps this below 2^-16), and builds boxes by floats, erring by 8u. Twice that is given.
inline constexpr float list_margin = 0x1p-15f;

/// Greatest translation of a pose, over the distance of the nearest surface, at which floats are trusted.
inline constexpr double largest_translation = 4;

/// The triangles of one cell: [first, last) of the lists.
struct CellRow {
  std::uint32_t first, last;
};

/// Four linear forms of a point v, side by side: a . v in lanes x[k] v_x + y[k] v_y + z[k] v_z. For a triangle
/// (a, b, c) with normal N and D = a . (b x c):
///
///     lanes 0 1 2    (a x b) / D, (b x c) / D, (c x a) / D      all > 0 where the ray through v crosses it
///     lane 3         N / |D|        its magnitude is |v| over the crossing's radius, > 1 where the crossing
///                                   lies before v; positive where the ray leaves the solid
///
/// NaN throughout where floats could not say enough of the triangle: a plane nearly through the centre, a
/// sliver. Every comparison with them is false, and the point is decided in double.
struct alignas(16) ConeForms {
  float x[4], y[4], z[4];
};

/// Relative error of a form's coefficients beyond their rounding to float: with that, a form of a point v errs by
/// less than form_error * max|v_k| * (|x| + |y| + |z|), and `form_error_of_translation` times |t| / r more. In
/// units of u: 1 for rounding a coefficient, 4 for this, 4 for the form's own operations, 10.4 for the point:
/// 6u (|v| + 2 |t|) in each coordinate, |v| <= sqrt(3) max|v_k|. The bound's own rounding takes the rest.
inline constexpr double coefficient_error = 0x1p-22;
inline constexpr float form_error = 24 * 0x1p-24f;
inline constexpr float form_error_of_translation = 24 * 0x1p-24f;

struct CubeView {
  int cells_per_side;
  int levels;                 ///< of the pyramid
  const RadiusWord* radii;    ///< of each cell
  const RadiusWord* pyramid;  ///< see DirectionPyramid
  const CellRow* row;
  const std::uint32_t* triangle;
  const std::uint32_t* box;  ///< of each listed triangle in its cell, see box_word()
  const ConeForms* forms;    ///< of each triangle
  RadiusScale scale;
  int winding_at_centre;
  float nearest_squared;  ///< no surface is nearer to the centre
};

/// Part of a cell that a triangle takes, in four bytes: least column, 255 - greatest column, least row,
/// 255 - greatest row. A point at (column, row) has box_word(column, column, row, row), and lies in the box
/// exactly where no byte of the box exceeds the point's.
constexpr std::uint32_t box_word(int least_column, int greatest_column, int least_row, int greatest_row) noexcept {
  return static_cast<std::uint32_t>(least_column) | static_cast<std::uint32_t>(255 - greatest_column) << 8 |
         static_cast<std::uint32_t>(least_row) << 16 | static_cast<std::uint32_t>(255 - greatest_row) << 24;
}

/// Whether no byte of the box exceeds the point's.
constexpr bool holds(std::uint32_t box, std::uint32_t point) noexcept {
  for (int shift = 0; shift < 32; shift += 8) {
    if ((box >> shift & 255) > (point >> shift & 255)) return false;
  }
  return true;
}

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

}  // namespace condyle
