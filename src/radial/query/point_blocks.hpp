#pragma once

#include <array>
#include <span>

#include "condyle/pose.hpp"
#include "core/uninitialised.hpp"

namespace condyle::radial {

/// Points of the mobile body in blocks of neighbours, made once for a mesh and a joint centre: what
/// RadialTable::penetrations reads. A block lies in a cap of directions about the centre and in an interval
/// of radii, so that whole blocks can be found free with one lookup in the table.
///
///        . axis        points p of a block:  | p / |p| - axis | <= chord,   nearest <= |p| <= furthest
///       /|  cap
///      / |             Point i here is point index()[i] of those given.
///     o--+---
class PointBlocks {
 public:
  /// Points in a block, and blocks in a block of the next level.
  static constexpr std::size_t fan = 16;
  /// Blocks of 16 points, and blocks of 256.
  static constexpr std::size_t levels = 2;

  /// Points in M's frame; `centre` is the joint centre in that frame. n log n.
  explicit PointBlocks(PointsView points, const Vec3& centre = Vec3::Zero());

  /// The points have moved: those that are marked, one mark for each; without marks, all. Blocks keep their points, in their order.
  void move(PointsView points, std::span<const char> is_moved = {});

  std::size_t size() const noexcept { return index_.size(); }
  std::size_t block_count(std::size_t level) const noexcept { return block_count_[level]; }
  /// The points given, in the order of the blocks, every bit kept.
  const Vec3& operator[](std::size_t i) const noexcept { return point_[i]; }
  /// Number that each point had among the points given.
  std::span<const Index> index() const noexcept { return index_; }
  const Vec3& centre() const noexcept { return centre_; }
  /// Distance of the furthest point from the centre, mm.
  double reach() const noexcept { return reach_; }

  /// Coordinates about the centre, rounded to float; the last block is filled up with its last point.
  const float* coordinate(std::size_t k) const noexcept { return rounded_[k].data(); }

  /// Blocks as columns of floats, rounded so that every point of the block fulfils what is said above; filled
  /// up to a multiple of 16 blocks. 1 / |p| lies within mean_inverse -+ spread.
  enum Column : std::size_t {
    axis_x,
    axis_y,
    axis_z,
    chord,
    nearest,
    furthest,
    mean_inverse,
    spread,
    columns
  };
  const float* block(std::size_t level, Column column) const noexcept { return block_[level][column].data(); }

 private:
  void round(std::size_t i);
  void describe_block(std::size_t level, std::size_t block);

  Vec3 centre_;
  double reach_ = 0;
  std::array<std::size_t, levels> block_count_;
  core::UninitialisedVector<Vec3> point_;
  core::UninitialisedVector<Index> index_;
  std::array<core::UninitialisedVector<float>, 3> rounded_;
  std::array<std::array<std::vector<float>, columns>, levels> block_;
};

}  // namespace condyle::radial
