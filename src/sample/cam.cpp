#include "sample/cam.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/rotation_about.hpp"
#include "core/trigonometry.hpp"

namespace condyle::sample {
namespace {

/// Radius of the bump in head radii.
constexpr double bump_radius = 0.55;

/// Between the circles where they cross, at first and when full grown. The height over the head is
/// sqrt(1 + b^2 - 2 b cos s) + b - 1 head radii: 0.04 and 0.14. Flatter, and where the contour leaves the
/// head depends on how closely one looks; steeper, and the bump is a wart.
constexpr Angle least_steepness = Angle::degrees(15), full_steepness = Angle::degrees(30);

/// How far the bump is swept around the neck to either side: three quarters of an hour.
constexpr Angle cam_sweep = Angle::degrees(22.5);

}  // namespace

FieldValue Cam::operator()(const Vec3& p) const noexcept {
  // The sweep's nearest place to p, by its angle around the neck, turned to the middle. The bar is the same
  // on both sides of its plane, so within the sweep its gradient lies in that plane and turns back with it.
  const Vec3 side = neck.cross(out);
  const double at =
      std::clamp(core::arctangent(p.dot(side), p.dot(out)), -cam_sweep.radians(), cam_sweep.radians());
  const Eigen::Matrix3d back = core::rotation_about(neck, -at);
  const FieldValue middle = bar(bump, end, back * p);
  return {middle.value, back.transpose() * middle.gradient};
}

std::array<Ball, 3> Cam::places() const noexcept {
  const Eigen::Matrix3d rotation = core::rotation_about(neck, cam_sweep.radians());
  return {bump, {rotation * bump.centre, bump.radius}, {rotation.transpose() * bump.centre, bump.radius}};
}

FieldValue Cam::seam(const Vec3& p) const noexcept {
  // narrow + wide t^2 / (t^2 + half^2), t from where the neck comes out of the head.
  const double narrow = head_radius / 60, wide = head_radius / 4, half = 0.4 * head_radius;
  const double t = p.dot(neck) - head_radius / 2;
  if (t <= 0) return {narrow, Vec3::Zero()};
  const double sum = t * t + half * half;
  return {narrow + wide * t * t / sum, (2 * wide * t * half * half / (sum * sum)) * neck};
}

Cam cam_crossing_at(const HipParameters& hip, Angle crossing, double grown) noexcept {
  const FemurAxes axes = femur_axes(hip);
  const Vec3 out = cam_direction(axes);
  const double radius = hip.head_radius_mm;
  const auto towards = [&](Angle angle) {
    return Vec3(core::cosine(angle.radians()) * axes.neck + core::sine(angle.radians()) * out);
  };
  // Where they cross, the bump's normal leans away from the neck by the steepness.
  const Angle steepness = least_steepness + (full_steepness - least_steepness) * grown;
  const Vec3 centre = radius * (towards(crossing) - bump_radius * towards(crossing + steepness));
  // A full one sinks into the neck slowly, on its own side.
  const double neck_radius = hip.neck_radius_mm;
  const Ball end = {(0.45 + 0.3 * grown) * axes.foot + 0.25 * grown * neck_radius * out,
                    (0.4 + 0.25 * grown) * neck_radius};
  return {{centre, bump_radius * radius}, end, radius, axes.neck, out};
}

}  // namespace condyle::sample
