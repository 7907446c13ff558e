#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "condyle/points.hpp"
#include "simd/packed_interval.hpp"

/// A cube table as the vector code reads it: plain arrays, borrowed from a RadialTable.

namespace condyle::radial {

using simd::greatest_radius_code, simd::IntervalScale, simd::no_radii, simd::packed_interval,
    simd::PackedInterval;

/// Cells are cut into so many parts each way; 8-DOPs of triangles within a cell are rounded outwards to
/// them.
inline constexpr int parts_per_cell = 256;

/// Widening of triangles in the lists of a cube map, in units of a face's coordinate (which spans [-1, 1]).
/// Vector code places a point by floats, which errs by at most
///
///     23 u + 42 u |t| / r,   u = 2^-24, t the pose's translation, r the radius of the nearest surface
///
/// (`largest_translation` keeps this below 2^-16), and triangles by floats that err by 8u. Twice that is
/// given.
inline constexpr float list_margin = 0x1p-15f;

/// Greatest translation of a pose, over the distance of the nearest surface, at which floats are trusted.
inline constexpr double largest_translation = 4;

/// The triangles of one cell: [first, last) of the lists. In long rows those of the cell's left half (u below
/// its middle) come first and those of the right half last:
///
///     first      | left half only  | both | right half only  |      last
///                                  ^      ^
///                        right_begin      left_end                  counted from `first`
struct CellRow {
  static constexpr std::uint16_t whole = 0xffff;

  std::uint32_t first, last;
  std::uint16_t left_end = whole, right_begin = 0;

  /// Those that a point with this axis part can meet. In which half it is cannot be predicted: bits choose, not
  /// branches.
  constexpr CellRow half_at(std::uint32_t axis) const noexcept {
    const std::uint32_t is_right = 0u - (axis >> 7 & 1u), end = left_end == whole ? last : first + left_end;
    return {first + (right_begin & is_right), end ^ ((end ^ last) & is_right)};
  }
};

/// Four linear forms of a point v, side by side: a . v in lanes x[k] v_x + y[k] v_y + z[k] v_z. For a
/// triangle (a, b, c) with normal N and D = a . (b x c):
///
///     lanes 0 1 2    (a x b) / D, (b x c) / D, (c x a) / D      all > 0 where the ray through v crosses it
///     lane 3         N / |D|        its magnitude is |v| over the crossing's radius, > 1 where the crossing
///                                   lies before v; positive where the ray leaves the solid
///
/// NaN throughout where floats could not say enough of the triangle: a plane nearly through the centre, a
/// sliver. Every comparison with them is false, and the point is decided in double.
///
/// `low` has what lane 3 leaves out: the sum of both is scaled_normal(), NaN where that is. `radii` are the
/// squared radii that the triangle takes, of the table's scale.
struct alignas(64) EdgeFunctions {
  float x[4], y[4], z[4], low[3];
  PackedInterval radii;
};

/// Relative error of a form's coefficients beyond their rounding to float: with that, a form of a point v
/// errs by less than form_error * max|v_k| * (|x| + |y| + |z|), and `form_error_of_translation` times |t| / r
/// more. In units of u: 1 for rounding a coefficient, 4 for this, 4 for the form's own operations, 10.4 for
/// the point: 6u (|v| + 2 |t|) in each coordinate, |v| <= sqrt(3) max|v_k|. The bound's own rounding takes
/// the rest.
inline constexpr double coefficient_error = 0x1p-22;
inline constexpr float form_error = 24 * 0x1p-24f;
inline constexpr float form_error_of_translation = 24 * 0x1p-24f;

/// The entries of a table's cells.
struct EntryView {
  const CellRow* row;
  const std::uint32_t* triangle;
  const std::uint32_t *axis, *diagonal;  ///< of each entry's triangle in its cell, see CellDop
};

struct CubeView {
  int cells_per_side;
  int levels;                     ///< of the pyramid
  const PackedInterval* radii;    ///< of each cell
  const PackedInterval* pyramid;  ///< see DirectionPyramid
  PackedInterval all_radii;
  EntryView entries;
  const std::uint8_t* nearest;  ///< code of the least squared radius of each entry's triangle, its upper half
  const EdgeFunctions* edge_functions;  ///< of each triangle
  IntervalScale scale;
  int winding_at_centre;
  float nearest_squared;   ///< no surface is nearer to the centre
  float furthest_squared;  ///< and none further away
};

/// Part of a cell that something takes, as an 8-DOP: parts (256 to a cell) from the cell's corner, between
/// a least and a greatest value of column u, of row w, and of the diagonals u + w and u - w. Four bytes each,
/// least and 255 - greatest, so that a point is in it exactly where no byte exceeds the point's own.
///
///         ____
///       /     |     axis      least u, 255 - greatest u, least w, 255 - greatest w
///     /       |     diagonal  the same of (u + w) / 2 and (u - w + 255) / 2
///    |______/
struct CellDop {
  std::uint32_t axis, diagonal;
};

constexpr std::uint32_t packed_range(int least_a, int greatest_a, int least_b, int greatest_b) noexcept {
  return static_cast<std::uint32_t>(least_a) | static_cast<std::uint32_t>(255 - greatest_a) << 8 |
         static_cast<std::uint32_t>(least_b) << 16 | static_cast<std::uint32_t>(255 - greatest_b) << 24;
}

/// The diagonal part of a point, from its axis part.
constexpr std::uint32_t diagonal_of_point(std::uint32_t axis) noexcept {
  const int u = static_cast<int>(axis & 255), w = static_cast<int>(axis >> 16 & 255);
  const int sum = (u + w) / 2, difference = (u - w + 255) / 2;
  return packed_range(sum, sum, difference, difference);
}

/// Whether no byte of the range exceeds the point's.
constexpr bool holds(std::uint32_t range, std::uint32_t point) noexcept {
  for (int shift = 0; shift < 32; shift += 8) {
    if ((range >> shift & 255) > (point >> shift & 255)) return false;
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

}  // namespace condyle::radial
