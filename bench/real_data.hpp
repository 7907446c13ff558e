#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "condyle/joint_coordinates.hpp"
#include "condyle/make_joint.hpp"

/// Real joints and motions, and where they are.

namespace bench {

/// The folder that CONDYLE_DATA names, or else shared/data beside the repository.
std::filesystem::path data_folder();

/// The rotations of a hip in a recorded walk (motion_gait2354_walk), no translation: its 73 frames, or `points` at equal
/// steps of the whole recording.
std::vector<std::optional<condyle::Pose>> walking_hip(condyle::Side side,
                                                      std::optional<std::size_t> points = {});

/// Frames of a walk in a quick run: a few of the beginning.
inline constexpr std::size_t quick_frames = 3;

}  // namespace bench
