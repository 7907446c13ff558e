#include "condyle/impingement_zone.hpp"

#include <cmath>

#include "condyle/error.hpp"
#include "core/trigonometry.hpp"
#include "kinematics/socket_rim.hpp"

namespace condyle::motion {
namespace {

/// Sine of one degree: nearer to the plane's normal a direction does not say where it points on the plane.
constexpr double smallest_sine = 0.0175;

/// The shell in which the femur is only neck, in head radii.
constexpr double shell_inner = 1.2, shell_outer = 1.6;

/// Length of the mean direction of the shell's surface: 1 for a thin rod, 0 for a sphere. A neck of half the
/// head's radius has 0.9.
constexpr double least_one_sided = 0.5;

}  // namespace

Angle ClockFace::angle_of(const Vec3& direction) const noexcept {
  const double angle = core::arctangent(direction.dot(three), direction.dot(twelve));
  return Angle::radians(angle < 0 ? angle + two_pi : angle);
}

double ClockFace::hour_of(const Vec3& direction) const noexcept {
  const double hour = angle_of(direction).radians() * (12 / two_pi);
  return hour < 12 ? hour : 0;
}

ClockFace clock_face(const Vec3& normal) {
  if (!normal.allFinite() || normal.isZero(0)) throw UsageError("clock face: the normal has no direction");
  const Vec3 n = normal.normalized();
  const Vec3 up = Vec3::UnitY() - n.y() * n;
  if (up.norm() < smallest_sine) throw UsageError("clock face: the normal is vertical: no 12 o'clock");
  const Vec3 twelve = up.normalized(), across = n.cross(twelve);
  if (std::abs(across.x()) < smallest_sine)
    throw UsageError("clock face: the plane is seen from the front: no 3 o'clock");
  return {twelve, across.x() > 0 ? across : Vec3(-across)};
}

ClockFace sagittal_clock() {
  return {Vec3::UnitY(), Vec3::UnitX()};
}

std::optional<ClockFace> find_rim_clock(const TriMesh& fixed, const Sphere& head) {
  const auto rim = kinematics::socket_rim(fixed, head);
  if (!rim || !rim->plane) return std::nullopt;
  const Vec3 twelve = -rim->plane->notch, across = rim->plane->normal.cross(twelve);
  if (std::abs(across.x()) < smallest_sine) return std::nullopt;
  return ClockFace{twelve, across.x() > 0 ? across : Vec3(-across)};
}

std::optional<NeckAxis> find_neck_axis(const TriMesh& mobile, double head_radius_mm) {
  const double inner = shell_inner * head_radius_mm, outer = shell_outer * head_radius_mm;
  Vec3 moment = Vec3::Zero();
  double area = 0, distance = 0;
  for (std::size_t t = 0; t < mobile.triangles.size(); ++t) {
    const Vec3 a = mobile.corner(t, 0), b = mobile.corner(t, 1), c = mobile.corner(t, 2);
    const auto in_shell = [&](const Vec3& p) { return p.norm() >= inner && p.norm() <= outer; };
    if (!in_shell(a) || !in_shell(b) || !in_shell(c)) continue;
    const double triangle_area = (b - a).cross(c - a).norm() / 2;
    const Vec3 middle = (a + b + c) / 3;
    moment += triangle_area * middle, distance += triangle_area * middle.norm(), area += triangle_area;
  }
  if (!(area > 0) || moment.norm() < least_one_sided * distance) return std::nullopt;
  return NeckAxis{moment.normalized()};
}

ClockFace neck_clock(const NeckAxis& neck) {
  return clock_face(neck.direction);
}

}  // namespace condyle::motion
