#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "condyle/kinematics/joint.hpp"

/// The joints that are measured.

namespace bench {

/// Names of all scenes: sample_1 to sample_4 are the sample hip at the resolutions of the founding paper,
/// the others real hips.
std::span<const std::string_view> scene_names();

/// The scene of that name; empty where it is a real joint and its meshes are not there. Real joints are read
/// from the folder that CONDYLE_DATA names, or else from shared/data beside the repository.
std::optional<condyle::Joint> make_scene(std::string_view name);

/// Poses at which queries are timed: neutral, free, grazing and deep ones of a usual hip.
std::span<const condyle::JointAngles> query_poses();

}  // namespace bench
