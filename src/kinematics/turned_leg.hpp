#pragma once

#include <optional>
#include <span>

#include "condyle/joint_checks.hpp"

namespace condyle::kinematics {

/// That the femur of a hip does not lie in neutral where its angles are zero: zero_pose(). Nothing where another note says that side, axes
/// or bodies are wrong: then it is these that are turned.
std::optional<JointNote> turned_leg_note(const Joint& joint, std::span<const JointNote> others);

}  // namespace condyle::kinematics
