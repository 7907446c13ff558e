#include "condyle/joint_coordinates.hpp"

#include <cassert>
#include <cmath>
#include <numbers>

#include "core/predicates.hpp"
#include "core/trigonometry.hpp"

namespace condyle {
namespace {

/// Sine and cosine, exact at multiples of 90 degrees.
///
/// A multiple of 90 degrees written in degrees reaches radians with three roundings (of pi, of pi/180 and of the product), so
/// where the smaller of the two is within 3u of the angle, the angle was meant to be that multiple. Near 0 the sine is as large
/// as the angle itself and no angle is mistaken for 0.
core::SineCosine sine_cosine(Angle angle) noexcept {
  const auto [sine, cosine] = core::sine_cosine(angle.radians());
  const double tolerance = 3 * core::rounding_unit * std::abs(angle.radians());
  if (std::abs(sine) <= tolerance) return {0, cosine > 0 ? 1.0 : -1.0};
  if (std::abs(cosine) <= tolerance) return {sine > 0 ? 1.0 : -1.0, 0};
  return {sine, cosine};
}

/// How a joint's three angles turn: about Z, X, Y or Y, X, Y, each in this sense.
struct Rotations {
  bool starts_about_y;  ///< Y-X-Y, else Z-X-Y
  double e1, e2, e3;
};

Rotations rotations_of(CoordinateSystem system) noexcept {
  const double sense = system.side == Side::right ? 1.0 : -1.0;  // of X and Y axes
  switch (system.anatomy) {
    case Anatomy::knee:
      return {false, -1.0, sense, sense};
    case Anatomy::shoulder:
      return {true, sense, -sense, sense};
    case Anatomy::hip:
    case Anatomy::ankle:
    case Anatomy::elbow:
      break;
  }
  return {false, 1.0, sense, sense};
}

/// The angle of (x, y) in (-180, 180] degrees: -180 is given as 180, and -0 taken as 0.
Angle angle_of(double y, double x) noexcept {
  const double radians = core::arctangent(y + 0.0, x);
  return Angle::radians(radians == -std::numbers::pi ? std::numbers::pi : radians);
}

/// In this sense; half a turn is the same in either.
Angle in_sense(double sense, Angle angle) noexcept {
  return angle.radians() == std::numbers::pi ? angle : angle * sense;
}

/// Angles of R_z R_x R_y.
JointAngles angles_about_zxy(const Rotations& sense, const Eigen::Matrix4d& R) noexcept {
  // Column 1 is (-sf ca, cf ca, sa) and row 2 is (-ca sr, sa, ca cr). With f known, row 0 of
  // R_z(-f) R = R_x(a) R_y(r) is (cr, 0, sr): well conditioned even where f itself is not, so that the three always
  // reproduce R.
  const double ca = std::sqrt(R(0, 1) * R(0, 1) + R(1, 1) * R(1, 1));
  const Angle adduction = angle_of(R(2, 1), ca);
  // Rounding leaves up to 4u in entries that would be 0 at the gimbal pose: an f from those would be noise.
  if (ca <= 4 * core::rounding_unit)
    return {in_sense(sense.e1, angle_of(R(1, 0), R(0, 0))), adduction * sense.e2, Angle()};
  const Angle flexion = angle_of(-R(0, 1), R(1, 1));
  const auto [sf, cf] = sine_cosine(flexion);
  const Angle rotation = angle_of(cf * R(0, 2) + sf * R(1, 2), cf * R(0, 0) + sf * R(1, 0));
  return {in_sense(sense.e1, flexion), adduction * sense.e2, in_sense(sense.e3, rotation)};
}

/// Angles of R_y R_x R_y, the second angle 0 or more.
JointAngles angles_about_yxy(const Rotations& sense, const Eigen::Matrix4d& R) noexcept {
  // Column 1 is (sp se, ce, cp se), se of the sense of e2. With p known, row 0 of R_y(-p) R = R_x(e) R_y(i) is
  // (ci, 0, si), well conditioned wherever p is not.
  const double se = std::sqrt(R(0, 1) * R(0, 1) + R(2, 1) * R(2, 1));
  const Angle elevation = angle_of(se, R(1, 1));
  // As above: at 0 and 180 degrees a p would be noise.
  const Angle plane =
      se <= 4 * core::rounding_unit ? Angle() : angle_of(sense.e2 * R(0, 1), sense.e2 * R(2, 1));
  const auto [sp, cp] = sine_cosine(plane);
  const Angle rotation = angle_of(cp * R(0, 2) - sp * R(2, 2), cp * R(0, 0) - sp * R(2, 0));
  return {in_sense(sense.e1, plane), elevation, in_sense(sense.e3, rotation)};
}

/// The axes along which a translation's components are, in F.
Eigen::Matrix3d translation_axes(CoordinateSystem system, const JointAngles& at, TranslationFrame frame,
                                 const Pose& X_FM) noexcept {
  if (frame == TranslationFrame::fixed) return Eigen::Matrix3d::Identity();
  assert(system.anatomy != Anatomy::shoulder);
  const Rotations sense = rotations_of(system);
  Eigen::Matrix3d axes;
  axes << sense.e2 * axis_of(JointAngle::adduction, system, at), X_FM.linear().col(1), Vec3::UnitZ();
  return axes;
}

}  // namespace

const std::array<AngleNames, 3>& coordinate_names(Anatomy joint) noexcept {
  using Names = std::array<AngleNames, 3>;
  static constexpr AngleNames rotation{"internal_rotation", "external_rotation"};
  static constexpr Names hip{{{"flexion", "extension"}, {"adduction", "abduction"}, rotation}},
      ankle{{{"dorsiflexion", "plantarflexion"}, {"inversion", "eversion"}, rotation}},
      elbow{{{"flexion", "extension"}, {"varus", "valgus"}, {"pronation", "supination"}}},
      shoulder{{{"plane_of_elevation", "posterior_plane_of_elevation"}, {"elevation", "lowering"}, rotation}};
  switch (joint) {
    case Anatomy::ankle:
      return ankle;
    case Anatomy::elbow:
      return elbow;
    case Anatomy::shoulder:
      return shoulder;
    case Anatomy::hip:
    case Anatomy::knee:
      break;
  }
  return hip;
}

Pose pose_at(CoordinateSystem system, const JointAngles& angles) noexcept {
  const Rotations sense = rotations_of(system);
  const auto [s1, c1] = sine_cosine(angles.flexion * sense.e1);
  const auto [s2, c2] = sine_cosine(angles.adduction * sense.e2);
  const auto [s3, c3] = sine_cosine(angles.internal_rotation * sense.e3);
  Pose X = Pose::Identity();
  // The three rotations multiplied out. Adding 0 turns -0 into 0: zero angles give the identity bit for bit.
  if (sense.starts_about_y)
    X.linear() << (c1 * c3 - s1 * c2 * s3) + 0.0, s1 * s2 + 0.0, (c1 * s3 + s1 * c2 * c3) + 0.0,  //
        s2 * s3 + 0.0, c2 + 0.0, -s2 * c3 + 0.0,                                                  //
        (-s1 * c3 - c1 * c2 * s3) + 0.0, c1 * s2 + 0.0, (c1 * c2 * c3 - s1 * s3) + 0.0;
  else
    X.linear() << (c1 * c3 - s1 * s2 * s3) + 0.0, -s1 * c2 + 0.0, (c1 * s3 + s1 * s2 * c3) + 0.0,  //
        (s1 * c3 + c1 * s2 * s3) + 0.0, c1 * c2 + 0.0, (s1 * s3 - c1 * s2 * c3) + 0.0,             //
        -c2 * s3 + 0.0, s2 + 0.0, c2 * c3 + 0.0;
  return X;
}

JointAngles angles_at(CoordinateSystem system, const Pose& X_FM) noexcept {
  const Rotations sense = rotations_of(system);
  return sense.starts_about_y ? angles_about_yxy(sense, X_FM.matrix())
                              : angles_about_zxy(sense, X_FM.matrix());
}

Vec3 axis_of(JointAngle angle, CoordinateSystem system, const JointAngles& at) noexcept {
  const Rotations sense = rotations_of(system);
  switch (angle) {
    case JointAngle::flexion:
      return sense.e1 * (sense.starts_about_y ? Vec3(Vec3::UnitY()) : Vec3(Vec3::UnitZ()));
    case JointAngle::adduction: {
      const auto [s1, c1] = sine_cosine(at.flexion * sense.e1);
      return sense.e2 * (sense.starts_about_y ? Vec3(c1, 0, -s1) : Vec3(c1, s1, 0));
    }
    case JointAngle::internal_rotation:
      break;
  }
  return sense.e3 * pose_at(system, at).linear().col(1);
}

Pose pose_at(CoordinateSystem system, const JointCoordinates& at, TranslationFrame frame) noexcept {
  Pose X = pose_at(system, at.angles);
  X.translation() = translation_axes(system, at.angles, frame, X) * at.translation_mm;
  return X;
}

JointCoordinates coordinates_at(CoordinateSystem system, const Pose& X_FM, TranslationFrame frame) noexcept {
  const JointAngles angles = angles_at(system, X_FM);
  const Vec3 t = X_FM.translation();
  if (frame == TranslationFrame::fixed) return {angles, t};
  // X is at right angles to both others; y + z k and z + y k are their projections, k the cosine between them.
  const Eigen::Matrix3d axes = translation_axes(system, angles, frame, X_FM);
  const Vec3 along = axes.transpose() * t;
  const double k = axes.col(1).dot(axes.col(2)), square_of_sine = (1 - k) * (1 + k);
  return {angles,
          {along.x(), (along.y() - k * along.z()) / square_of_sine,
           (along.z() - k * along.y()) / square_of_sine}};
}

Angle angle_of(const JointAngles& angles, JointAngle angle) noexcept {
  switch (angle) {
    case JointAngle::flexion:
      return angles.flexion;
    case JointAngle::adduction:
      return angles.adduction;
    case JointAngle::internal_rotation:
      break;
  }
  return angles.internal_rotation;
}

std::string_view name_of(Side side) noexcept {
  return side == Side::right ? "right" : "left";
}

std::string_view name_of(JointKind kind) noexcept {
  switch (kind) {
    case JointKind::ball:
      return "ball";
    case JointKind::hinge:
      return "hinge";
    case JointKind::free:
      break;
  }
  return "free";
}

std::string_view name_of(Anatomy joint) noexcept {
  switch (joint) {
    case Anatomy::hip:
      return "hip";
    case Anatomy::knee:
      return "knee";
    case Anatomy::ankle:
      return "ankle";
    case Anatomy::elbow:
      return "elbow";
    case Anatomy::shoulder:
      break;
  }
  return "shoulder";
}

std::string_view name_of(TranslationFrame frame) noexcept {
  return frame == TranslationFrame::fixed ? "fixed" : "joint_axes";
}

std::string_view name_of(JointAngle angle, Anatomy joint) noexcept {
  return coordinate_names(joint)[static_cast<std::size_t>(angle)].positive;
}

}  // namespace condyle
