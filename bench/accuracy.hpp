#pragma once

#include <cstdint>

#include "reference.hpp"

/// How far a method's answers are from the exact ones, counted over the poses it was asked at.

namespace bench {

/// A depth that is off by more is counted as a wrong one: a tenth of the depths that matter in a joint, and a fifth of a
/// voxel of a fine CT.
inline constexpr double wrong_depth_mm = 0.1;

/// Vertices: what a method says of each. A vertex exactly on the surface may be called either.
struct InsideAccuracy {
  std::int64_t inside = 0;  ///< In truth.
  std::int64_t false_inside = 0, false_outside = 0;
  std::int64_t depths = 0;      ///< Compared: vertices truly inside that have a reported depth.
  std::int64_t depths_off = 0;  ///< How many of them are off by more than wrong_depth_mm.
  double depth_error_sum_mm = 0, depth_error_max_mm = 0;

  double mean_depth_error_mm() const {
    return depths > 0 ? depth_error_sum_mm / static_cast<double>(depths) : 0;
  }
  bool agrees() const { return false_inside == 0 && false_outside == 0; }
  InsideAccuracy& operator+=(const InsideAccuracy& more);
};

struct TouchAccuracy {
  std::int64_t poses = 0, touching = 0;  ///< Touching in truth.
  std::int64_t missed = 0, invented = 0;

  bool agrees() const { return missed == 0 && invented == 0; }
  TouchAccuracy& operator+=(const TouchAccuracy& more);
};

struct PairAccuracy {
  std::int64_t pairs = 0;  ///< In truth.
  std::int64_t missed = 0, invented = 0;

  bool agrees() const { return missed == 0 && invented == 0; }
  PairAccuracy& operator+=(const PairAccuracy& more);
};

/// Adds one pose. The answers are sorted by the way.
void compare(std::vector<InsideVertex>& answer, Reference& reference, std::size_t pose, DepthKind kind,
             InsideAccuracy& accuracy);
void compare(std::vector<condyle::contact::TrianglePair>& answer, Reference& reference, std::size_t pose,
             PairAccuracy& accuracy);
void compare(bool touches, Reference& reference, std::size_t pose, TouchAccuracy& accuracy);

}  // namespace bench
