#pragma once

#include <cstdint>

#include "simd/packed_range.hpp"

/// Where in a cell of a cube map directions and triangles are, in whole numbers.

namespace condyle::radial {

using simd::packed_range;

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

/// Part of a cell that something takes, as an 8-DOP: parts (256 to a cell) from the cell's corner, between
/// a least and a greatest value of column u, of row w, and of the diagonals u + w and u - w.
///
///         ____
///       /     |     axis      ranges of u and of w
///     /       |     diagonal  ranges of (u + w) / 2 and of (u - w + 255) / 2
///    |______/
struct CellDop {
  simd::PackedRange axis, diagonal;
};

/// The diagonal part of a point, from its axis part.
constexpr std::uint32_t diagonal_of_point(std::uint32_t axis) noexcept {
  const int u = static_cast<int>(axis & 255), w = static_cast<int>(axis >> 16 & 255);
  const int sum = (u + w) / 2, difference = (u - w + 255) / 2;
  return packed_range(sum, sum, difference, difference);
}

}  // namespace condyle::radial
