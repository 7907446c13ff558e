#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "condyle/angle.hpp"
#include "condyle/fit.hpp"
#include "condyle/inspect.hpp"
#include "condyle/joint.hpp"
#include "condyle/joint_coordinates.hpp"
#include "condyle/mesh.hpp"
#include "condyle/pose.hpp"

/// Where a joint frame lies in the frame its meshes were given in. X_WF is the pose of the joint frame F in
/// that frame W: p_F = X_WF^-1 p_W. Axes: X anterior, Y superior, Z = X x Y to the subject's right, on both
/// sides.
///
/// A joint from two meshes in one unit, both in one frame W as a segmentation gives them, or each in a frame of its own that
/// lies in W. Where the joint frame F lies in W is given by directions, landmarks or a fit, and both meshes are placed in it.
///
///     JointDescription right_hip{.name = "right hip", .kind = JointKind::ball, .side = Side::right};
///     right_hip.frame.centre = CentreFit{};  // the centre of the femoral head
///     const auto [joint, placement] = make_joint(right_hip, {"hip bone", hip_bone}, {"femur", femur});

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

  [[nodiscard]] double largest() const noexcept {
    return std::max({anterior_length, superior_length, right_angle});
  }
  [[nodiscard]] bool none() const noexcept {
    return anterior_length == 0 && superior_length == 0 && right_angle == 0;
  }
};
[[nodiscard]] AxisErrors axis_errors(const Vec3& anterior, const Vec3& superior) noexcept;

/// A joint frame from its centre and two directions. Both must be unit vectors at a right angle within
/// axis_tolerance; what rounding left is then removed by scaling both and rotating each by half of the angle
/// they were off. Orthonormal input is used as it is, bit for bit. Throws UsageError, saying by how much the
/// directions are off.
[[nodiscard]] Pose frame_from_axes(const Vec3& centre, const Vec3& anterior, const Vec3& superior);

// The frames from landmarks throw UsageError if landmarks coincide or lie on one line. Points in mm.

/// Pelvic frame of the International Society of Biomechanics (Wu et al., J Biomech 35, 2002): Z parallel to
/// the line from the left to the right anterior superior iliac spine (ASIS), X in the plane of both ASIS and
/// the midpoint of the posterior ones (PSIS), at a right angle to Z, forwards; Y upwards. The origin is the
/// hip centre.
struct PelvisLandmarks {
  Vec3 right_asis, left_asis, right_psis, left_psis;
};
[[nodiscard]] Pose frame_from_landmarks(const Vec3& centre, const PelvisLandmarks& landmarks);

/// Anterior pelvic plane, as used for planning cups: Y and Z in the plane of both ASIS and the pubic
/// symphysis, Z parallel to the line from the left to the right ASIS, Y upwards, X forwards.
struct AnteriorPelvicPlane {
  Vec3 right_asis, left_asis, pubic_symphysis;
};
[[nodiscard]] Pose frame_from_landmarks(const Vec3& centre, const AnteriorPelvicPlane& landmarks);

/// Femoral frame of the same recommendation: Y from the midpoint of the epicondyles to the hip centre, Z at a
/// right angle to it in the plane of all three points, to the right, X forwards. The origin is the hip
/// centre.
struct FemurLandmarks {
  Vec3 medial_epicondyle, lateral_epicondyle;
};
[[nodiscard]] Pose frame_from_landmarks(const Vec3& hip_centre, Side side, const FemurLandmarks& landmarks);

/// A hinge at the knee: Z along the epicondyles to the right, origin at their midpoint, Y at a right angle to
/// Z in their plane with the hip centre, upwards, X forwards.
struct TransepicondylarAxis {
  Vec3 medial_epicondyle, lateral_epicondyle, hip_centre;
};
[[nodiscard]] Pose frame_from_landmarks(Side side, const TransepicondylarAxis& landmarks);

/// The axes of a joint frame as unit vectors in W: orthonormal within axis_tolerance or refused.
struct FrameDirections {
  Vec3 anterior = Vec3::UnitX();
  Vec3 superior = Vec3::UnitY();
};

/// Axes of images, named by the directions in which x, y and z point: Right Anterior Superior, Left Posterior
/// Superior.
inline const FrameDirections ras_axes{Vec3::UnitY(), Vec3::UnitZ()}, lps_axes{-Vec3::UnitY(), Vec3::UnitZ()};

/// The centre of a ball is that of the sphere fitted to its head (mobile) or its socket (fixed), and so is that of a free
/// hip or shoulder; the axis of a hinge, and of another free joint, is that of the cylinder fitted to the body.
struct CentreFit {
  BodyRole body = BodyRole::mobile;
  std::optional<Sphere> within = {};  ///< only vertices inside this ball are considered; mm, in W
};

/// Where a joint frame lies in W; lengths in mm, whatever the unit of the meshes.
struct FrameDescription {
  /// Not read if the axes are a TransepicondylarAxis, which gives the centre too; else nothing means the
  /// origin of W.
  std::variant<std::monostate, Vec3, CentreFit> centre = {};
  std::variant<FrameDirections, PelvisLandmarks, AnteriorPelvicPlane, FemurLandmarks, TransepicondylarAxis>
      axes = {};
  /// The mobile body's own axes: zero angles are where they and `axes` coincide, and the pose in which the mobile mesh is
  /// given follows from both.
  std::optional<FemurLandmarks> mobile_axes = {};
};

/// A part, whose centre lies in W if it is not the joint centre. Planes that it is cut by lie in W, and then the first of its meshes is the one
/// that is cut: the only one of the body if it names none.
struct DescribedPart {
  PosedPart part = {};
  std::optional<Vec3> centre_in_W = {};  ///< mm
};

/// A ligament, its points and its wrap in the frames that the meshes of their bodies are given in, mm.
struct DescribedLigament {
  Ligament ligament = {};
  /// In place of a slack length: the angles at which it is just taut, or its slack length as a share of its length in the reference pose.
  std::optional<JointAngles> taut_at = {};
  std::optional<double> slack_share = {};
  /// The wrap is the head of the mobile body.
  bool wraps_head = false;
};

/// All that makes a joint of two meshes.
struct JointDescription {
  std::string name;
  JointKind kind = JointKind::ball;
  Side side = Side::right;
  LengthUnit units = LengthUnit::millimetres;  ///< of both meshes
  FrameDescription frame = {};
  /// The pose in which the mobile mesh is given; its angles are zero if the frame has mobile_axes, or if they are from the anatomy.
  JointCoordinates reference_pose = {};
  /// What these angles are known by: `stated` says that they are, zero or not, and other angles than zero say so by themselves; with
  /// `anatomy` those of a hip follow from the condyles of its femur (zero_pose()). Landmarks need no word.
  ZeroFrom zero_from = ZeroFrom::as_given;
  Anatomy anatomy = Anatomy::hip;  ///< of a hinge: the hip stands for any joint that flexes forwards
  TranslationFrame translation_frame = TranslationFrame::fixed;  ///< of a free joint
  /// X_WB of each body, in mm: where the frame B in which its mesh is given lies in W, in the reference pose.
  Pose fixed_in_W = Pose::Identity(), mobile_in_W = Pose::Identity();
  /// Parts with a pose of their own: they move the bodies once these are placed.
  std::vector<DescribedPart> parts = {};
  std::string planned = {};  ///< what a plan did to the bones, as Joint::planned
  Person person = {};
  std::vector<DescribedLigament> ligaments = {};

  [[nodiscard]] CoordinateSystem coordinates() const noexcept { return {anatomy, side}; }
};

/// Report of how a mesh was placed in the joint.
struct BodyPlacement {
  LikelyUnit likely_unit;  ///< unit that its size suggests; the description's unit is used
  BoundingBox bounds;      ///< of all its vertices, in the joint frame at zero angles, mm
};

/// How the meshes came into the joint frame, for checking.
struct JointPlacement {
  Pose X_WF;                                ///< the joint frame in W, mm
  std::optional<SphericalPatch> sphere;     ///< the fit that gave the centre of a ball
  std::optional<CylinderFit> cylinder;      ///< the fit that gave the axis of a hinge
  BodyRole fitted_body = BodyRole::mobile;  ///< that either was fitted to
  Angle axis_rotation;                      ///< from the Z axis of the description to the fitted one
  AxisErrors axis_errors{0, 0, 0};          ///< of the directions as given; removed
  JointCoordinates reference_pose = {};     ///< as described, or as it follows from landmarks or anatomy
  ZeroFrom zero_from = ZeroFrom::as_given;
  BodyPlacement fixed, mobile;
  std::vector<std::string> processing;  ///< one line each: which axes were corrected, what was fitted
};

struct PlacedJoint {
  Joint joint;
  JointPlacement placement;
};

/// Places both bodies in the joint frame, from the poses of their meshes in W, p_W = X_WB p_B:
///
///     p_F = X_WF^-1 p_W                        fixed vertices
///     p_M = X_FM(reference pose)^-1 X_WF^-1 p_W   mobile vertices; with mobile_axes or anatomy X_WM^-1 p_W
///
/// Each coordinate, conversion from metres included, is computed in extended precision and rounded once. With
/// millimetres, the centre 0, the standard axes and a reference pose of zero, vertices keep every bit.
///
/// Throws UsageError if the description is inconsistent (axes that are not orthonormal, landmarks that coincide,
/// meshes whose sizes suggest two units, coordinates too large), MeshError if a fit finds nothing or an axis more
/// than 45 degrees from the one described, and for a reference pose from the anatomy if the femur shows no condyles. One line that begins with the part of the description it is about
/// ("frame", "frame.centre", "units") or the name of the body.
///
/// Linear in the meshes, but for a fit, which searches the surface.
[[nodiscard]] PlacedJoint make_joint(const JointDescription& description, Body fixed, Body mobile);

}  // namespace condyle
