#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "condyle/points.hpp"
#include "radial/build/radius_scale.hpp"

namespace condyle::radial {

/// Radii of ever larger pieces of a cube map, each piece with a border around it: one look tells about a
/// whole cap of directions.
///
/// Step s has pieces of 2^k x 2^k cells, n = N >> k along a side. Its entry for a piece holds the radii of
/// all directions whose coordinates on the face differ from one of the piece's own by no more than `border`
/// pieces, on other faces too:
///
///     step        0   1   2   3   4   5   6  ...       +---+---+---+---+---+
///     k           0   0   0   1   1   2   2            |   |   | o-----> |   |    border 2: o may be
///     displaced border      1   2   3   2   3   2   3            +---+---+---+---+---+     by two pieces
///     both ways room, cells 1   2   3   4   6   8  12
///
/// There are pieces as long as n is even and at least four.
class DirectionPyramid {
 public:
  static int step_count(int cells_per_side) noexcept;
  static int level_of(int step) noexcept { return step == 0 ? 0 : (step - 1) / 2; }
  static int border_of(int step) noexcept { return step == 0 ? 1 : 2 + (step - 1) % 2; }
  /// Where the entries of a step begin: face by face and row by row.
  static std::size_t start_of(int step, int cells_per_side) noexcept;
  static std::size_t entry_count(int cells_per_side) noexcept;

  /// The widest border.
  static constexpr std::size_t most_border = 3;

  /// From the radii of each cell of a CubeMap. Linear in cells.
  void fill(int cells_per_side, std::span<const RadiusWord> cells);
  /// The same where the radii of the changed cells alone are others than they were: fills those faces that
  /// have such a cell, or one within a border of them.
  void refill(int cells_per_side, std::span<const RadiusWord> cells, std::span<const Index> changed);

  const RadiusWord* data() const noexcept { return entry_.data(); }
  /// Radii of all directions together: for caps that are wider than any border.
  RadiusWord all() const noexcept { return all_; }
  std::size_t size() const noexcept { return entry_.size(); }

 private:
  /// Faces to fill on each level, a bit for each.
  using FacesOfLevels = std::array<std::uint8_t, 16>;
  static constexpr std::uint8_t all_faces = 0x3f;

  void fill_faces(int cells_per_side, std::span<const RadiusWord> cells, const FacesOfLevels& faces);

  std::vector<RadiusWord> entry_;
  RadiusWord all_ = no_radii;
  std::vector<RadiusWord> room_;  // for filling
};

}  // namespace condyle::radial
