#pragma once

#include <string>
#include <string_view>

#include "condyle/joint_coordinates.hpp"

namespace condyle {

/// A pose in degrees and mm, as somebody wrote it: an Angle is in radians, and degrees that come back from there may
/// differ in the last digit.
struct PoseDegrees {
  double flexion = 0, adduction = 0, internal_rotation = 0;  ///< about e1, e2, e3, as in JointAngles
  Vec3 translation_mm = Vec3::Zero();                        ///< of a free joint

  double operator[](JointAngle angle) const noexcept {
    return angle == JointAngle::flexion     ? flexion
           : angle == JointAngle::adduction ? adduction
                                            : internal_rotation;
  }

  JointAngles angles() const noexcept {
    return {Angle::degrees(flexion), Angle::degrees(adduction), Angle::degrees(internal_rotation)};
  }
  JointCoordinates coordinates() const noexcept { return {angles(), translation_mm}; }
  friend bool operator==(const PoseDegrees&, const PoseDegrees&) = default;
};

/// Reads a pose as people write it: "flexion=90 adduction=-10 internal_rotation=20", in degrees, in any
/// order, separated by spaces or commas, by the names that the joint's angles have (coordinate_names()). Angles left out
/// are 0; the empty text is the neutral pose. Under its negative name, `extension`, an angle has the opposite sign. Throws
/// UsageError on unknown names, on an angle given twice under either name, on anything that is not a finite
/// number, and on a hinge for angles other than the first other than 0.
PoseDegrees parse_pose(std::string_view text, JointKind kind, Anatomy joint);

/// The pose as parse_pose() reads it, every digit of it: "flexion=90 adduction=-10 internal_rotation=20".
std::string to_text(const PoseDegrees& pose, Anatomy joint);

std::string_view name_of(Side side) noexcept;
std::string_view name_of(JointKind kind) noexcept;
std::string_view name_of(Anatomy joint) noexcept;
std::string_view name_of(TranslationFrame frame) noexcept;
/// "flexion", or what the joint calls this angle: the positive one of its coordinate_names().
std::string_view name_of(JointAngle angle, Anatomy joint) noexcept;

/// The joint's angle of that name; throws UsageError with the names there are.
JointAngle joint_angle_named(std::string_view name, Anatomy joint);

}  // namespace condyle
