#pragma once

#include <array>

#include "condyle/pose.hpp"
#include "core/coordinate_range.hpp"

namespace condyle::io {

/// A rotation off by more than this is refused as none; what tables with seven digits have is accepted.
using core::largest_skew;

struct PoseOfRows {
  Pose X;
  double
      skew;  ///< largest entry of R^T R - 1 where the nearest rotation is given instead; 0 if none was needed
};

/// A pose from its matrix row by row, finite numbers; its rotation as it is, or where it is none to rounding the nearest
/// one. Throws UsageError, "the ...", where the last row is not 0 0 0 1 or the rotation is none: off by more than
/// largest_skew, or a mirror.
PoseOfRows pose_of_rows(const std::array<double, 16>& rows);

}  // namespace condyle::io
