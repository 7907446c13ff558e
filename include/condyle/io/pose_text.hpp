#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "condyle/contact.hpp"
#include "condyle/joint.hpp"
#include "condyle/joint_coordinates.hpp"

namespace condyle::io {

/// A pose in degrees and mm, as somebody wrote it: an Angle is in radians, and degrees that come back from there may
/// differ in the last digit.
struct PoseDegrees {
  double flexion = 0, adduction = 0, internal_rotation = 0;  ///< about e1, e2, e3, as in JointAngles
  Vec3 translation_mm = Vec3::Zero();                        ///< of a free joint

  [[nodiscard]] double operator[](JointAngle angle) const noexcept {
    return angle == JointAngle::flexion     ? flexion
           : angle == JointAngle::adduction ? adduction
                                            : internal_rotation;
  }

  [[nodiscard]] JointAngles angles() const noexcept {
    return {Angle::degrees(flexion), Angle::degrees(adduction), Angle::degrees(internal_rotation)};
  }
  [[nodiscard]] JointCoordinates coordinates() const noexcept { return {angles(), translation_mm}; }
  friend bool operator==(const PoseDegrees&, const PoseDegrees&) = default;
};

/// Reads a pose as people write it: "flexion=90 adduction=-10 internal_rotation=20", in degrees, in any
/// order, separated by spaces or commas, by the names that the joint's angles have (coordinate_names()). Angles left out
/// are 0; the empty text is the neutral pose. Under its negative name, `extension`, an angle has the opposite sign. A free
/// joint has `x`, `y` and `z` besides, in mm. Throws UsageError on unknown names, on one given twice under either name, on
/// anything that is not a finite number, and on a hinge for angles other than the first other than 0.
[[nodiscard]] PoseDegrees parse_pose(std::string_view text, JointKind kind, Anatomy joint);

/// A pose as it is used and by its coordinates.
struct PoseArgument {
  PoseDegrees pose;
  Pose X_FM;
  std::vector<std::string> notes = {};  ///< one line each: what was made of it
};

/// Whether a text gives a pose as a matrix: it begins with a number.
[[nodiscard]] bool is_matrix(std::string_view text) noexcept;

/// A pose of this joint, by its coordinates as parse_pose() reads them or as the matrix X_FM (p_F = X_FM p_M, lengths in mm):
/// 16 numbers row by row, separated by blanks, commas or line ends, the last four 0 0 0 1. Its rotation must be orthonormal
/// within 1e-6; where it is not to rounding the nearest rotation is used, and a note says so. Throws UsageError for
/// anything else, for a matrix with a translation if the joint does not translate, and for one that turns a hinge out of
/// its axis.
[[nodiscard]] PoseArgument given_pose(std::string_view text, const Joint& joint);

/// Two bodies without a joint have a pose as a matrix only; the rest as given_pose().
[[nodiscard]] PoseArgument matrix_pose(std::string_view text);

/// The pose as parse_pose() reads it, every digit of it: "flexion=90 adduction=-10 internal_rotation=20".
[[nodiscard]] std::string to_text(const PoseDegrees& pose, Anatomy joint);

/// What arcs go about: the name of an angle of the joint, three numbers for an axis through the joint centre, or six, the last three
/// a point of it in mm; both in F, separated by blanks or commas. Throws UsageError for anything else.
[[nodiscard]] contact::ArcsAbout arcs_about(std::string_view text, Anatomy joint);

/// The joint's angle of that name; throws UsageError that lists the valid names.
[[nodiscard]] JointAngle joint_angle_named(std::string_view name, Anatomy joint);

}  // namespace condyle::io
