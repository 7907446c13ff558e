#pragma once

#include <optional>

#include "condyle/joint_checks.hpp"

namespace condyle::kinematics {

/// Evidence of a femur's condyles and shaft against the axes and the side of a knee, whose mobile body, a tibia or a patella, is posed
/// by X_FM. The axes that the femur shows are held against those of the joint:
///
///                superior, up the shaft           within 72 degrees of Y, else   axes_not_upright
///        ^   .-. |                                the condyles' axis within 30 degrees of Z, else   axes_turned
///      anterior |  to the right (condyles' axis)  front and right backwards: axes_turned, or mirrored of the other side
///                                                 the other side: wrong_side
///
/// Empty if nothing is wrong, and if no two condyles are found. Some tens of milliseconds for 60,000 triangles.
std::optional<JointNote> condyle_note(const Joint& joint, const Pose& X_FM);

}  // namespace condyle::kinematics
