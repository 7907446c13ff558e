#pragma once

#include <optional>
#include <vector>

#include "condyle/joint.hpp"

namespace condyle::io {

/// 16 numbers, row by row.
std::vector<double> rows_of(const Pose& X_FM);

/// Frames of a recorded motion as the page plays them: of each three angles, three lengths, and X_FM row by row; NaN in a gap.
struct RecordedFrames {
  std::vector<double> coordinates_deg, coordinates_mm, poses;
};

RecordedFrames recorded_frames(const Joint& joint, const std::vector<std::optional<Pose>>& X_FM);

}  // namespace condyle::io
