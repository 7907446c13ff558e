#pragma once

#include <span>
#include <vector>

#include "condyle/core/vec3.hpp"
#include "condyle/radial/radius_scale.hpp"

namespace condyle {

/// Radii of ever larger pieces of a cube map, each piece with a border around it: one look tells about a
/// whole cap of directions.
///
/// Level k has n = N >> k cells along a side and starts at 8 (N^2 - n^2); there are levels as long as n is
/// even and at least four. An entry holds the radii of its own 2^k x 2^k cells and of all directions whose
/// coordinates on the face differ from one of its own by no more than the width of an entry, on other faces
/// too.
///
///       +---+---+---+
///       |   |   |   |      the entry of the middle piece covers all nine
///       +---+---+---+
///       |   | o-->  |      o may be displaced by a piece's width in both coordinates
///       +---+---+---+
///       |   |   |   |
///       +---+---+---+
class DirectionPyramid {
 public:
  /// Four cells in each direction keep the rows of two faces that meet at an edge apart.
  static int level_count(int cells_per_side) noexcept;
  static std::size_t entry_count(int cells_per_side) noexcept;

  /// From the radii of each cell of a CubeMap. Linear in cells.
  void fill(int cells_per_side, std::span<const RadiusWord> cells);

  const RadiusWord* data() const noexcept { return entry_.data(); }
  std::size_t size() const noexcept { return entry_.size(); }

 private:
  std::vector<RadiusWord> entry_;
  std::vector<Index> beyond_;     // cells beyond those at the edges of faces, level by level
  std::vector<RadiusWord> room_;  // for filling
};

}  // namespace condyle
