#pragma once

#include <array>
#include <limits>
#include <span>
#include <vector>

#include "sample/field.hpp"

namespace condyle::sample {

/// A solid stretched over balls that are joined by bars (a chain) or plates (a sheet), smoothed by
/// subdivision: few control balls give a rounded form without beads along a chain or ribs across a sheet, as
/// its pieces share balls and slope gently into each other.
class Skeleton {
 public:
  /// Nothing: infinitely far from everywhere.
  Skeleton() = default;

  /// A bent bar: cubic B-spline through the control balls, radii included, which starts and ends in the first
  /// and last one. At least two balls.
  static Skeleton chain(std::span<const Ball> control);

  /// A bent plate: Loop's subdivision surface (Loop 1987, his weights) over the control triangles, radii
  /// included; its border is the cubic B-spline of the border balls. Every edge in one or two triangles.
  static Skeleton sheet(std::span<const Ball> control, std::span<const std::array<Index, 3>> triangles);

  /// The union of all pieces, without filled seams: they meet nearly tangentially.
  FieldValue operator()(const Vec3& p) const noexcept {
    return up_to(std::numeric_limits<double>::infinity(), p);
  }

  /// The same where the value is at most this; elsewhere the same or infinity, which is found much sooner.
  FieldValue up_to(double most, const Vec3& p) const noexcept;

  std::span<const Ball> balls() const noexcept { return balls_; }

 private:
  /// Piece (a, b, c); a bar has c equal to b.
  struct Piece {
    Index a, b, c;
  };
  static constexpr std::size_t most_groups = 32, pieces_per_block = 8;
  /// Consecutive pieces [first, last) inside one ball: far away, the ball alone shows that they cannot be
  /// nearest.
  struct Group {
    Ball around;
    std::size_t first, last;
  };
  Ball around(std::size_t first, std::size_t last) const;
  void group(std::size_t pieces_per_group);

  std::vector<Ball> balls_;
  std::vector<Piece> pieces_;
  std::vector<Plate> plates_;  ///< of a sheet's pieces; empty for a chain
  std::vector<Ball> around_piece_;
  std::vector<Ball> around_block_;  ///< of pieces_per_block consecutive pieces
  std::vector<Group> groups_;
};

}  // namespace condyle::sample
