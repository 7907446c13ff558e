#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "condyle/pose.hpp"
#include "simd/packed_interval.hpp"

namespace condyle::radial {

using simd::no_radii, simd::PackedInterval;

/// A min-max pyramid of radii: hulls over ever larger tiles of a cube map, each dilated by some tiles around
/// it, so that one look is about a whole cap of directions.
///
/// A level has tiles of 2^k x 2^k cells, n = N >> k along a side. Its entry for a tile is the hull of the
/// radii of all directions whose coordinates on the face differ from one of the tile's own by no more than
/// `dilation` tiles, on other faces too:
///
///     level                 0  1  2  3  4  5  6 ...    +---+---+---+---+---+
///     k, halvings           0  0  0  1  1  2  2        |   |   | o-----> |   |    dilation 2: o may be
///     dilation, tiles       1  2  3  2  3  2  3        +---+---+---+---+---+      displaced by two tiles
///     displacement, cells   1  2  3  4  6  8 12                                   both ways
///
/// Tiles are halved in number as long as n is even and at least four are left along a side.
class DirectionPyramid {
 public:
  static int level_count(int cells_per_side) noexcept;
  static int halvings_of(int level) noexcept { return level == 0 ? 0 : (level - 1) / 2; }
  static int dilation_of(int level) noexcept { return level == 0 ? 1 : 2 + (level - 1) % 2; }
  /// Where the entries of a level begin: face by face and row by row.
  static std::size_t start_of(int level, int cells_per_side) noexcept;
  static std::size_t entry_count(int cells_per_side) noexcept;

  /// The widest dilation.
  static constexpr std::size_t most_dilation = 3;

  /// From the radii of each cell of a CubeMap. Linear in cells.
  void fill(int cells_per_side, std::span<const PackedInterval> cells);
  /// The same where the radii of the changed cells only differ from what they were: fills those faces that
  /// have such a cell, or one within a dilation of them.
  void refill(int cells_per_side, std::span<const PackedInterval> cells, std::span<const Index> changed);

  const PackedInterval* data() const noexcept { return entry_.data(); }
  std::size_t size() const noexcept { return entry_.size(); }

 private:
  /// Faces to fill for each size of tiles, a bit for each.
  using FacesOfSizes = std::array<std::uint8_t, 16>;
  static constexpr std::uint8_t all_faces = 0x3f;

  void fill_faces(int cells_per_side, std::span<const PackedInterval> cells, const FacesOfSizes& faces);

  std::vector<PackedInterval> entry_;
  std::vector<PackedInterval> scratch_;  // for filling
};

}  // namespace condyle::radial
