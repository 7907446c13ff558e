#pragma once

#include "condyle/joint_coordinates.hpp"
#include "condyle/pose.hpp"

/// Where a joint frame lies in the frame its meshes were given in. X_WF is the pose of the joint frame F in
/// that frame W: p_F = X_WF^-1 p_W. Axes: X anterior, Y superior, Z = X x Y to the subject's right, on both
/// sides.

namespace condyle {

/// How far a direction may be from unit length, and half of how far the cosine between two of them may be
/// from 0, to be taken as orthonormal: a vector written with six decimals is off by up to sqrt(3) * 0.5e-6,
/// two of them by twice that. Beyond it they are refused, not corrected: an angle of 2e-6 moves the far end
/// of a femur by 0.001 mm.
inline constexpr double axis_tolerance = 1e-6;

/// Two landmarks nearer than this (mm) do not fix a direction: a landmark is picked to about one millimetre.
inline constexpr double smallest_landmark_distance = 1;

/// Sine of the angle at which three landmarks are still a plane and not a line: 1 degree.
inline constexpr double smallest_landmark_sine = 0.0175;

/// How far two directions are from being orthonormal.
struct AxisErrors {
  double anterior_length;  ///< |length - 1|
  double superior_length;  ///< |length - 1|
  double right_angle;      ///< |cosine of the angle between them|

  bool none() const noexcept { return anterior_length == 0 && superior_length == 0 && right_angle == 0; }
};
AxisErrors axis_errors(const Vec3& anterior, const Vec3& superior) noexcept;

/// A joint frame from its centre and two directions. Both must be unit vectors at a right angle within
/// axis_tolerance; what rounding left is then removed by scaling both and rotating each by half of the angle
/// they were off. Orthonormal input is used as it is, bit for bit. Throws UsageError, saying by how much the
/// directions are off.
Pose frame_from_axes(const Vec3& centre, const Vec3& anterior, const Vec3& superior);

// The frames from landmarks throw UsageError if landmarks coincide or lie on one line. Points in mm.

/// Pelvic frame of the International Society of Biomechanics (Wu et al., J Biomech 35, 2002): Z parallel to
/// the line from the left to the right anterior superior iliac spine (ASIS), X in the plane of both ASIS and
/// the midpoint of the posterior ones (PSIS), at a right angle to Z, forwards; Y upwards. The origin is the
/// hip centre.
struct PelvisLandmarks {
  Vec3 right_asis, left_asis, right_psis, left_psis;
};
Pose frame_from_landmarks(const Vec3& centre, const PelvisLandmarks& landmarks);

/// Anterior pelvic plane, as used for planning cups: Y and Z in the plane of both ASIS and the pubic
/// symphysis, Z parallel to the line from the left to the right ASIS, Y upwards, X forwards.
struct AnteriorPelvicPlane {
  Vec3 right_asis, left_asis, pubic_symphysis;
};
Pose frame_from_landmarks(const Vec3& centre, const AnteriorPelvicPlane& landmarks);

/// Femoral frame of the same recommendation: Y from the midpoint of the epicondyles to the hip centre, Z at a
/// right angle to it in the plane of all three points, to the right, X forwards. The origin is the hip
/// centre.
struct FemurLandmarks {
  Vec3 medial_epicondyle, lateral_epicondyle;
};
Pose frame_from_landmarks(const Vec3& hip_centre, Side side, const FemurLandmarks& landmarks);

/// A hinge at the knee: Z along the epicondyles to the right, origin at their midpoint, Y at a right angle to
/// Z in their plane with the hip centre, upwards, X forwards.
struct TransepicondylarAxis {
  Vec3 medial_epicondyle, lateral_epicondyle, hip_centre;
};
Pose frame_from_landmarks(Side side, const TransepicondylarAxis& landmarks);

}  // namespace condyle
