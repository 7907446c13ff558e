#pragma once

#include <string>
#include <string_view>

#include "condyle/joint_coordinates.hpp"

namespace condyle {

/// Reads a pose as people write it: "flexion=90 adduction=-10 internal_rotation=20", in degrees, in any
/// order, separated by spaces or commas. Angles left out are 0; the empty text is the neutral pose.
/// `extension`, `abduction` and `external_rotation` are the same angles with the opposite sign. Throws
/// UsageError on unknown names, on an angle given twice under either name, on anything that is not a finite
/// number, and on a hinge for angles other than flexion other than 0.
JointAngles parse_pose(std::string_view text, JointKind kind);

/// The pose as parse_pose() reads it, in degrees with twelve digits: "flexion=90 adduction=-10
/// internal_rotation=20".
std::string to_text(const JointAngles& angles);

std::string_view name_of(Side side) noexcept;
std::string_view name_of(JointKind kind) noexcept;
std::string_view name_of(JointAngle angle) noexcept;

/// The angle of that name; throws UsageError with the names there are.
JointAngle joint_angle_named(std::string_view name);

}  // namespace condyle
