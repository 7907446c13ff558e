#include "condyle/joint_coordinates.hpp"

#include <cmath>

#include "core/predicates.hpp"

namespace condyle {
namespace {

struct SineCosine {
  double sine, cosine;
};

/// Sine and cosine, exact at multiples of 90 degrees.
///
/// Taken in extended precision and rounded once: the double versions of common libraries differ in the last
/// bit between instruction sets. A multiple of 90 degrees written in degrees reaches radians with three
/// roundings (of pi, of pi/180 and of the product), so where the smaller of the two is within 3u of the
/// angle, the angle was meant to be that multiple. Near 0 the sine is as large as the angle itself and no
/// angle is mistaken for 0.
SineCosine sine_cosine(Angle angle) noexcept {
  const long double radians = angle.radians();
  const auto sine = static_cast<double>(std::sin(radians));
  const auto cosine = static_cast<double>(std::cos(radians));
  const double tolerance = 3 * core::rounding_unit * std::abs(angle.radians());
  if (std::abs(sine) <= tolerance) return {0, cosine > 0 ? 1.0 : -1.0};
  if (std::abs(cosine) <= tolerance) return {sine > 0 ? 1.0 : -1.0, 0};
  return {sine, cosine};
}

/// The sense of the last two axes: +X and +Y on a right joint, -X and -Y on a left one.
double sense(Side side) noexcept {
  return side == Side::right ? 1.0 : -1.0;
}

/// The angle of (x, y) in (-180, 180] degrees: atan2 with -180 given as 180, and -0 taken as 0. Extended
/// precision as above.
Angle angle_of(double y, double x) noexcept {
  const auto radians =
      static_cast<double>(std::atan2(static_cast<long double>(y + 0.0), static_cast<long double>(x)));
  return Angle::radians(radians == -std::numbers::pi ? std::numbers::pi : radians);
}

}  // namespace

Pose pose_at(Side side, const JointAngles& angles) noexcept {
  const auto [sf, cf] = sine_cosine(angles.flexion);
  const auto [sa, ca] = sine_cosine(angles.adduction * sense(side));
  const auto [sr, cr] = sine_cosine(angles.internal_rotation * sense(side));
  Pose X = Pose::Identity();
  // R_z(f) R_x(a) R_y(r) multiplied out. Adding 0 turns -0 into 0: zero angles give the identity bit for bit.
  X.linear() << (cf * cr - sf * sa * sr) + 0.0, -sf * ca + 0.0, (cf * sr + sf * sa * cr) + 0.0,  //
      (sf * cr + cf * sa * sr) + 0.0, cf * ca + 0.0, (sf * sr - cf * sa * cr) + 0.0,             //
      -ca * sr + 0.0, sa + 0.0, ca * cr + 0.0;
  return X;
}

JointAngles angles_at(Side side, const Pose& X_FM) noexcept {
  const auto& R = X_FM.matrix();
  // Column 1 is (-sf ca, cf ca, sa) and row 2 is (-ca sr, sa, ca cr). With f known, row 0 of
  // R_z(-f) R = R_x(a) R_y(r) is (cr, 0, sr): well conditioned even where f itself is not, so that the three always
  // reproduce R.
  const double ca = std::sqrt(R(0, 1) * R(0, 1) + R(1, 1) * R(1, 1));
  const Angle adduction = angle_of(R(2, 1), ca);
  // Rounding leaves up to 4u in entries that would be 0 at the gimbal pose: an f from those would be noise.
  if (ca <= 4 * core::rounding_unit) return {angle_of(R(1, 0), R(0, 0)), adduction * sense(side), Angle()};
  const Angle flexion = angle_of(-R(0, 1), R(1, 1));
  const auto [sf, cf] = sine_cosine(flexion);
  const Angle rotation = angle_of(cf * R(0, 2) + sf * R(1, 2), cf * R(0, 0) + sf * R(1, 0));
  const bool half_turn = rotation.radians() == std::numbers::pi;
  return {flexion, adduction * sense(side), half_turn ? rotation : rotation * sense(side)};
}

Vec3 axis_of(JointAngle angle, Side side, const JointAngles& at) noexcept {
  switch (angle) {
    case JointAngle::flexion:
      return Vec3::UnitZ();
    case JointAngle::adduction: {
      const auto [sf, cf] = sine_cosine(at.flexion);
      return sense(side) * Vec3(cf, sf, 0);
    }
    case JointAngle::internal_rotation:
      break;
  }
  return sense(side) * pose_at(side, at).linear().col(1);
}

}  // namespace condyle
