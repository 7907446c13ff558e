#pragma once

#include <array>
#include <string_view>

#include "condyle/angle.hpp"
#include "condyle/pose.hpp"

/// The clinical coordinates of a joint and the poses they name: docs/mathematics/01-setting.md.
///
/// The joint frame F has X anterior, Y superior, Z to the subject's right, on both sides of the body. A pose of the
/// mobile body M is three rotations, each about the axis as the earlier ones left it. On a right joint
///
///     hip       R_FM = R_z(flexion) R_x(adduction) R_y(internal rotation)              Wu et al. 2002
///     knee      R_FM = R_z(-flexion) R_x(adduction) R_y(internal rotation)             Grood and Suntay 1983
///     ankle     R_FM = R_z(dorsiflexion) R_x(inversion) R_y(internal rotation)         Wu et al. 2002
///     elbow     R_FM = R_z(flexion) R_x(varus) R_y(pronation)                          Wu et al. 2005
///     shoulder  R_FM = R_y(plane of elevation) R_x(-elevation) R_y(internal rotation)  Wu et al. 2005
///
/// and on a left one the same with X and Y axes negated, so that one sign means one movement on either side.

namespace condyle {

enum class Side { right, left };

/// Which joint it is: it decides the order, the signs and the names of the angles.
enum class Anatomy { hip, knee, ankle, elbow, shoulder };

inline constexpr std::array all_anatomies{Anatomy::hip, Anatomy::knee, Anatomy::ankle, Anatomy::elbow,
                                          Anatomy::shoulder};

/// A joint's coordinate system: what its angles turn about.
struct CoordinateSystem {
  Anatomy anatomy = Anatomy::hip;
  Side side = Side::right;

  friend bool operator==(const CoordinateSystem&, const CoordinateSystem&) = default;
};

/// A ball rotates in all three angles about its centre; a hinge in the first only, about its Z axis; a free joint rotates
/// in all three and translates.
enum class JointKind { ball, hinge, free };

/// The three angles by the names they have at a hip and a knee; coordinate_names() has those of other joints.
enum class JointAngle {
  flexion,            ///< about e1, fixed in F
  adduction,          ///< about e2, the common perpendicular of e1 and e3
  internal_rotation,  ///< about e3, fixed in M
};

inline constexpr std::array all_joint_angles{JointAngle::flexion, JointAngle::adduction,
                                             JointAngle::internal_rotation};

/// The angles about e1, e2 and e3, named after the hip and the knee.
struct JointAngles {
  Angle flexion;
  Angle adduction;
  Angle internal_rotation;

  friend bool operator==(const JointAngles&, const JointAngles&) = default;
};

/// Names of an angle above zero and below zero.
struct AngleNames {
  std::string_view positive, negative;
};

/// The clinical names of a joint's three angles, in the order of JointAngle, with underscores:
///
///              e1                                e2                  e3
///     hip      flexion, extension                adduction, abduction   internal_, external_rotation
///     knee     flexion, extension                adduction, abduction   internal_, external_rotation
///     ankle    dorsiflexion, plantarflexion      inversion, eversion    internal_, external_rotation
///     elbow    flexion, extension                varus, valgus          pronation, supination
///     shoulder plane_of_elevation, posterior_plane_of_elevation   elevation, lowering   internal_, external_rotation
[[nodiscard]] const std::array<AngleNames, 3>& coordinate_names(Anatomy joint) noexcept;

/// X_FM at these angles: a rotation about the joint centre. Any finite angles. Exactly the identity at zero,
/// and every entry exactly 0, 1 or -1 if all three are multiples of 90 degrees.
[[nodiscard]] Pose pose_at(CoordinateSystem system, const JointAngles& angles) noexcept;

/// The angles of a pose; only the rotation is read. The first and the third are in (-180, 180] degrees, the second in
/// [-90, 90], the elevation of a shoulder in [0, 180]. Where e1 and e3 lie along one line (to rounding) the pose fixes
/// only the sum or difference of those two: at +-90 degrees of adduction internal rotation is given as 0, at 0 and 180
/// degrees of elevation the plane of elevation is. pose_at() of the answer is the rotation again to rounding, there and
/// everywhere.
[[nodiscard]] JointAngles angles_at(CoordinateSystem system, const Pose& X_FM) noexcept;

/// The unit axis in F about which the mobile body rotates when one angle grows and the other two are held:
/// rotating M counter-clockwise about it by d is adding d to that angle.
///
///     flexion            e1 = +-Z (shoulder +-Y)         whatever the angles
///     adduction          e2 = R(flexion) (+-X)           depends on flexion
///     internal rotation  e3 = R_FM (+-Y)                 depends on flexion and adduction
[[nodiscard]] Vec3 axis_of(JointAngle angle, CoordinateSystem system, const JointAngles& at) noexcept;

/// Along which axes the components of a translation are.
enum class TranslationFrame {
  fixed,  ///< X, Y and Z of F
  /// e2, e3 and e1, each in the sense of X, Y and Z at zero angles (Grood and Suntay 1983): oblique, and not for a shoulder,
  /// whose e1 and e3 start along one line.
  joint_axes
};

/// Where a body is that rotates and translates.
struct JointCoordinates {
  JointAngles angles;
  Vec3 translation_mm = Vec3::Zero();  ///< of the mobile body's origin; x, y and z of the translation frame

  friend bool operator==(const JointCoordinates&, const JointCoordinates&) = default;
};

/// X_FM of p_F = R_FM p_M + t, t the translation brought into F.
[[nodiscard]] Pose pose_at(CoordinateSystem system, const JointCoordinates& at,
                           TranslationFrame frame) noexcept;

/// The coordinates of a pose: angles_at() and the translation. Along joint axes the translation is not finite, or without
/// meaning, where e1 and e3 lie along one line.
[[nodiscard]] JointCoordinates coordinates_at(CoordinateSystem system, const Pose& X_FM,
                                              TranslationFrame frame) noexcept;

/// This angle of the three.
[[nodiscard]] Angle angle_of(const JointAngles& angles, JointAngle angle) noexcept;

[[nodiscard]] std::string_view name_of(Side side) noexcept;
[[nodiscard]] std::string_view name_of(JointKind kind) noexcept;
[[nodiscard]] std::string_view name_of(Anatomy joint) noexcept;
[[nodiscard]] std::string_view name_of(TranslationFrame frame) noexcept;
/// "flexion", or what the joint calls this angle: the positive one of its coordinate_names().
[[nodiscard]] std::string_view name_of(JointAngle angle, Anatomy joint) noexcept;

}  // namespace condyle
