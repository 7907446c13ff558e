#pragma once

#include <optional>

#include "condyle/joint_checks.hpp"

namespace condyle::kinematics {

/// That the socket around a head is far too large for it, as that of a bone around the ball of an implant whose cup is not among the meshes. For
/// joints in which no socket of the head's size was found.
std::optional<JointNote> loose_head_note(const Joint& joint, const Sphere& head);

}  // namespace condyle::kinematics
