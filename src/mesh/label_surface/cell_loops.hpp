#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace condyle::mesh {

// The corners, edges and faces of a cell between eight samples.
//
//        6 ------- 7         corner c is at (c & 1, c >> 1 & 1, c >> 2 & 1).
//       /|        /|         Edge 4 a + b is along axis a, from the corner edge_ends[.][0] to edge_ends[.][1].
//      4 ------- 5 |         Face 2 a + s is square to axis a, low (s = 0) or high (s = 1).
//      | 2 ------|-3   z y
//      |/        |/    |/    A set of corners, edges or faces is a number with their bits.
//      0 ------- 1     +-x

inline constexpr int cell_corners = 8, cell_edges = 12, cell_faces = 6;

/// Two other axes of an axis, in ascending order.
constexpr std::array<int, 2> other_axes(int axis) {
  return axis == 0 ? std::array{1, 2} : axis == 1 ? std::array{0, 2} : std::array{0, 1};
}

inline constexpr auto edge_ends = [] {
  std::array<std::array<int, 2>, cell_edges> ends{};
  for (int axis = 0; axis < 3; ++axis) {
    for (int b = 0; b < 4; ++b) {
      const auto [u, v] = other_axes(axis);
      const int low = ((b & 1) << u) | ((b >> 1) << v);
      ends[static_cast<std::size_t>(4 * axis + b)] = {low, low | (1 << axis)};
    }
  }
  return ends;
}();

/// The corners of each face, counter-clockwise seen from outside of the cell.
inline constexpr auto face_corners = [] {
  std::array<std::array<int, 4>, cell_faces> corners{};
  for (int axis = 0; axis < 3; ++axis) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (int side = 0; side < 2; ++side) {
      const int at = side << axis;
      std::array<int, 4> cycle{at, at | (1 << u), at | (1 << u) | (1 << v), at | (1 << v)};
      if (side == 0) cycle = {cycle[0], cycle[3], cycle[2], cycle[1]};
      corners[static_cast<std::size_t>(2 * axis + side)] = cycle;
    }
  }
  return corners;
}();

/// A loop of the surface on the boundary of a cell: the edges that it crosses, so that the inside is to the left of it
/// seen from outside of the cell.
struct CellLoop {
  std::array<std::uint8_t, cell_edges> edge{};
  int size = 0;
  /// Places in the loop from which it may be cut into triangles: no diagonal from there lies in a face of the cell.
  unsigned apexes = 0;
};

struct CellLoops {
  std::array<CellLoop, 4> loop{};
  int size = 0;
};

/// Faces of which two opposite corners are inside and two outside.
unsigned ambiguous_faces(unsigned inside);

/// The loops of a cell. On an ambiguous face the two corners inside are joined if the face is among `joined`, otherwise
/// the two outside.
CellLoops loops_of_cell(unsigned inside, unsigned joined);

}  // namespace condyle::mesh
