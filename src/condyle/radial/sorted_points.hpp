#pragma once

#include <array>

#include "condyle/core/vec3.hpp"

namespace condyle {

/// Points of the mobile body in blocks of neighbours, made once for a mesh and a joint centre: what
/// RadialTable::penetrations reads. A block lies in a cap of directions about the centre and in an interval of
/// radii, so that whole blocks can be told to be free with one look at the table.
///
///        . axis        points p of a block:  | p / |p| - axis | <= chord,   nearest <= |p| <= furthest
///       /|  cap
///      / |             "Point" number i here is point index()[i] of the points given.
///     o--+---
class SortedPoints {
 public:
  static constexpr std::size_t points_per_block = 16;

  /// Points in M's frame; `centre` is the joint centre in that frame. n log n.
  explicit SortedPoints(PointsView points, const Vec3& centre = Vec3::Zero());

  std::size_t size() const noexcept { return index_.size(); }
  std::size_t block_count() const noexcept { return block_count_; }
  /// The points given, in the order of the blocks, every bit kept.
  const Points& points() const noexcept { return points_; }
  /// Number that each point had among the points given.
  std::span<const Index> index() const noexcept { return index_; }
  const Vec3& centre() const noexcept { return centre_; }
  /// Distance of the furthest point from the centre, mm.
  double reach() const noexcept { return reach_; }

  /// Coordinates about the centre, rounded to float; the last block is filled up with its last point.
  const float* coordinate(int k) const noexcept { return rounded_[static_cast<std::size_t>(k)].data(); }

  /// Blocks as columns of floats, rounded so that every point of the block fulfils what is said above.
  enum Column : std::size_t { axis_x, axis_y, axis_z, chord, nearest, furthest, mean_inverse, spread, columns };
  const float* block(Column column) const noexcept { return block_[column].data(); }

 private:
  void describe_block(std::size_t block);

  Vec3 centre_;
  double reach_ = 0;
  std::size_t block_count_ = 0;
  Points points_;
  std::vector<Index> index_;
  std::array<std::vector<float>, 3> rounded_;
  std::array<std::vector<float>, columns> block_;
};

}  // namespace condyle
