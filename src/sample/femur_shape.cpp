#include "sample/femur_shape.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "core/trigonometry.hpp"
#include "sample/cam.hpp"
#include "sample/skeleton.hpp"

namespace condyle::sample {
namespace {

/// Lean of the shaft: the foot stands nearer the midline than the greater trochanter, the angle between the
/// shaft and the line from hip to knee.
constexpr Angle shaft_lean = Angle::degrees(7);

/// Head radius at which the lengths below were chosen, mm.
constexpr double nominal_head_radius = 24;

/// Anteversion at which the trochanters' places below were chosen.
constexpr Angle nominal_anteversion = Angle::degrees(15);

/// Room around the balls for filled seams, mm at the nominal size.
constexpr double margin_around_femur = 10;

/// The pieces of one femur, blended in this order.
struct FemurPieces {
  Ball head;
  Ball neck_upper_foot, neck_lower_foot;
  Plate neck;
  Skeleton shaft;
  Ball greater_tip, greater_side, greater_back;
  Plate greater;
  Ball lesser, lesser_root;
  std::optional<Cam> cam;
  Vec3 distal;
  double cut = 0;
  double scale = 1;

  FieldValue operator()(const Vec3& p) const noexcept {
    FieldValue bone = shaft(p);
    bone = joined(bone, greater(p), 14 * scale);
    bone = joined(bone, bar(lesser_root, lesser, p), 12 * scale);
    bone = joined(bone, bar(greater_back, lesser, p), 10 * scale);
    bone = joined(bone, neck(p), 10 * scale);
    bone = joined(bone, ball(head, p), 7 * scale);
    if (cam) bone = joined(bone, (*cam)(p), cam->seam(p));
    return common(bone, half_space(distal, cut, p), 8 * scale);
  }
};

/// Downwards at right angles to the neck, in the plane of neck and shaft.
Vec3 across_neck(const FemurAxes& axes) noexcept {
  return axes.neck.cross(axes.distal.cross(axes.neck)).normalized();
}

/// Everything but the cam.
FemurPieces femur_without_cam(const HipParameters& hip) {
  const FemurAxes axes = femur_axes(hip);
  const double scale = hip.head_radius_mm / nominal_head_radius;
  // The trochanters rotate about the shaft with the neck: torsion takes place below them.
  const double torsion = (hip.femoral_anteversion - nominal_anteversion).radians();
  const Vec3 anterior = core::cosine(torsion) * Vec3::UnitX() + core::sine(torsion) * axes.lateral;
  const Vec3 lateral = core::cosine(torsion) * axes.lateral - core::sine(torsion) * Vec3::UnitX();
  // A point by its distances from the foot, in millimetres at the nominal size: up, forward, to the side.
  const auto at = [&](double up, double forward, double side, double radius) {
    const Vec3 offset = -up * axes.distal + forward * anterior + side * lateral;
    return Ball{axes.foot + scale * offset, scale * radius};
  };
  // The neck is higher than it is deep, more so towards its foot.
  const Vec3 across = across_neck(axes);
  const double neck_radius = hip.neck_radius_mm;

  FemurPieces femur;
  femur.scale = scale;
  femur.distal = axes.distal;
  femur.cut = (axes.foot + hip.shaft_length_mm * axes.distal).dot(axes.distal);
  femur.head = {Vec3::Zero(), hip.head_radius_mm};
  const Ball neck_inside_head = {0.3 * hip.head_radius_mm * axes.neck, neck_radius};
  femur.neck_upper_foot = {axes.foot - 0.5 * neck_radius * across, neck_radius};
  femur.neck_lower_foot = {axes.foot + 0.5 * neck_radius * across, neck_radius};
  femur.neck = Plate(neck_inside_head, femur.neck_upper_foot, femur.neck_lower_foot);
  // Widest below the trochanters; its lower end lies beyond the cut.
  const Ball shaft_end = {axes.foot + (hip.shaft_length_mm + 10 * scale) * axes.distal, 13.5 * scale};
  const std::array<Ball, 3> shaft = {at(4, 0, 0, 17), at(-50, 0, 0, 13.5), shaft_end};
  femur.shaft = Skeleton::chain(shaft);
  femur.greater_tip = at(31, -12, 13, 9);
  femur.greater_side = at(8, -3, 15, 12);
  femur.greater_back = at(16, -15, 10, 9.5);
  femur.greater = Plate(femur.greater_tip, femur.greater_side, femur.greater_back);
  femur.lesser_root = at(-16, -8, -10, 10);
  femur.lesser = at(-17, -14, -17, 7.5);
  return femur;
}

/// The point in the cam's plane at this angle from the neck's axis that is just outside the head's circle.
Vec3 leaving_at(const HipParameters& hip, double angle_rad) noexcept {
  const FemurAxes axes = femur_axes(hip);
  const Vec3 towards = core::cosine(angle_rad) * axes.neck + core::sine(angle_rad) * cam_direction(axes);
  return (1 + cam_departure) * hip.head_radius_mm * towards;
}

/// Where a function changes sign, to the last bit or so: positive at one end, not at the other.
template <class Function>
double sign_change(double positive, double other, const Function& f) {
  constexpr int halvings = 60;
  for (int i = 0; i < halvings; ++i) {
    const double middle = (positive + other) / 2;
    (f(middle) > 0 ? positive : other) = middle;
  }
  return other;
}

/// The cam with which the contour leaves the head at this angle: the crossing is moved until it does, as
/// seams and the neck have a part in it. It is least at the native angle and full grown 12
/// degrees above.
Cam cam_leaving_at(const HipParameters& hip, Angle alpha, FemurPieces femur) {
  constexpr Angle growth = Angle::degrees(12);
  const double above_native = (alpha - native_alpha_angle(hip)).radians() / growth.radians();
  const double grown = std::clamp(above_native, 0.0, 1.0);
  const Vec3 leaving = leaving_at(hip, alpha.radians());
  const auto value = [&](double crossing) {
    femur.cam = cam_crossing_at(hip, Angle::radians(crossing), grown);
    return femur(leaving).value;
  };
  // So far below, the bump is out of reach of that point; so far above, the point is deep in it.
  constexpr Angle below = Angle::degrees(40), above = Angle::degrees(15);
  const double crossing = sign_change((alpha - below).radians(), (alpha + above).radians(), value);
  return cam_crossing_at(hip, Angle::radians(crossing), grown);
}

}  // namespace

FemurAxes femur_axes(const HipParameters& hip) noexcept {
  const double lean = shaft_lean.radians(), anteversion = hip.femoral_anteversion.radians();
  const double bend = std::numbers::pi - hip.neck_shaft_angle.radians();
  FemurAxes axes;
  axes.distal = Vec3(0, -core::cosine(lean), -core::sine(lean));
  axes.lateral = Vec3(0, -core::sine(lean), core::cosine(lean));
  axes.neck = core::sine(bend) *
                  (core::cosine(anteversion) * axes.lateral - core::sine(anteversion) * Vec3::UnitX()) +
              core::cosine(bend) * axes.distal;
  axes.foot = hip.neck_length_mm * axes.neck;
  return axes;
}

Vec3 cam_direction(const FemurAxes& axes) noexcept {
  const Vec3 superior = -across_neck(axes), anterior = superior.cross(axes.neck);
  return (superior + anterior).normalized();
}

Angle native_alpha_angle(const HipParameters& hip) {
  const FemurPieces femur = femur_without_cam(hip);
  // Straight away from the neck there is nothing but the head; along its axis there is the neck.
  return Angle::radians(
      sign_change(std::numbers::pi, 0, [&](double angle) { return femur(leaving_at(hip, angle)).value; }));
}

Solid femur_shape(const HipParameters& hip) {
  FemurPieces femur = femur_without_cam(hip);
  std::vector<Ball> details;
  if (hip.alpha_angle) {
    femur.cam = cam_leaving_at(hip, *hip.alpha_angle, femur);
    const auto places = femur.cam->places();
    details.assign(places.begin(), places.end());
  }
  const std::array<Ball, 9> balls = {femur.head,
                                     femur.neck_upper_foot,
                                     femur.neck_lower_foot,
                                     femur.shaft.balls().front(),
                                     femur.shaft.balls().back(),
                                     femur.greater_tip,
                                     femur.greater_side,
                                     femur.greater_back,
                                     femur.lesser};
  const Box box = box_around(balls);
  const Vec3 margin = Vec3::Constant(margin_around_femur * femur.scale);
  return {femur, {box.low - margin, box.high + margin}, details};
}

}  // namespace condyle::sample
