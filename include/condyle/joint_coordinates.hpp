#pragma once

#include "condyle/angle.hpp"
#include "condyle/pose.hpp"

/// The clinical angles of a joint and the poses they name: docs/mathematics.md, section 1.
///
/// The joint frame has its origin at the joint centre, X anterior, Y superior, Z to the subject's right, on
/// both sides of the body. A right joint rotates by
///
///     R_FM = R_z(flexion) R_x(adduction) R_y(internal rotation)
///
/// and a left one by the same with the last two axes negated, so that one sign means one movement on either
/// side:
///
///     flexion            > 0 brings the mobile body forwards     e1 = Z, fixed in F
///     adduction          > 0 brings it towards the midline       e2, the common perpendicular of e1 and e3
///     internal rotation  > 0 brings its front to the midline     e3 = Y (right) or -Y (left), fixed in M

namespace condyle {

enum class Side { right, left };

/// A ball rotates in all three angles about its centre; a hinge in flexion only, about its Z axis.
enum class JointKind { ball, hinge };

enum class JointAngle { flexion, adduction, internal_rotation };

struct JointAngles {
  Angle flexion;
  Angle adduction;
  Angle internal_rotation;

  friend bool operator==(const JointAngles&, const JointAngles&) = default;
};

/// X_FM at these angles: a rotation about the joint centre. Any finite angles. Exactly the identity at zero,
/// and every entry exactly 0, 1 or -1 where all three are multiples of 90 degrees.
Pose pose_at(Side side, const JointAngles& angles) noexcept;

/// The angles of a pose: flexion and internal rotation in (-180, 180], adduction in [-90, 90] degrees. Only
/// the rotation is read. At adduction = +-90 degrees (to rounding) flexion and internal rotation are about
/// one line and the pose fixes only their sum or difference: internal rotation is then given as 0.
/// pose_at() of the answer is the rotation again to rounding, there and everywhere.
JointAngles angles_at(Side side, const Pose& X_FM) noexcept;

/// The unit axis in F about which the mobile body rotates when one angle grows and the other two are held:
/// rotating M counter-clockwise about it by d is adding d to that angle.
///
///     flexion            e1 = Z                          whatever the angles
///     adduction          e2 = R(flexion) (+-X)           depends on flexion
///     internal rotation  e3 = R_FM (+-Y)                 depends on flexion and adduction
Vec3 axis_of(JointAngle angle, Side side, const JointAngles& at) noexcept;

}  // namespace condyle
