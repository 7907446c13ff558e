#include <cmath>

#include "condyle/implant.hpp"
#include "core/trigonometry.hpp"

namespace condyle::plan {
namespace {

core::SineCosine of_angle(Angle angle) noexcept {
  return core::sine_cosine(angle.radians());
}

Angle arc_sine(double x) noexcept {
  return Angle::radians(core::arctangent(x, std::sqrt(std::max(0.0, (1 - x) * (1 + x)))));
}

Angle between(double y, double x) noexcept {
  return Angle::radians(core::arctangent(y, x));
}

Vec3 on_side(Vec3 of_right, Side side) noexcept {
  if (side == Side::left) of_right.z() = -of_right.z();
  return of_right;
}

}  // namespace

Vec3 cup_axis(const CupAngles& angles, Side side) noexcept {
  const auto [si, ci] = of_angle(angles.inclination);
  const auto [sv, cv] = of_angle(angles.anteversion);
  switch (angles.definition) {
    case CupDefinition::radiographic:
      return on_side({sv, -ci * cv, si * cv}, side);
    case CupDefinition::anatomic:
      return on_side({si * sv, -ci, si * cv}, side);
    case CupDefinition::operative:
      break;
  }
  return on_side({ci * sv, -ci * cv, si}, side);
}

CupAngles cup_angles(const Vec3& axis, CupDefinition definition, Side side) noexcept {
  const Vec3 c = on_side(axis / axis.norm(), side);
  switch (definition) {
    case CupDefinition::radiographic:
      return {between(c.z(), -c.y()), arc_sine(c.x()), definition};
    case CupDefinition::anatomic:
      return {between(core::hypotenuse(c.x(), c.z()), -c.y()), between(c.x(), c.z()), definition};
    case CupDefinition::operative:
      break;
  }
  return {arc_sine(c.z()), between(c.x(), -c.y()), definition};
}

CupAngles by_definition(const CupAngles& angles, CupDefinition definition) noexcept {
  if (angles.definition == definition) return angles;
  return cup_angles(cup_axis(angles, Side::right), definition, Side::right);
}

Vec3 neck_axis(Angle neck_shaft, Angle version, Side side) noexcept {
  // cos(180 - a) = -cos a, sin(180 - a) = sin a.
  const auto [sine, cosine] = of_angle(neck_shaft);
  const auto [sv, cv] = of_angle(version);
  return on_side({-sv * sine, cosine, cv * sine}, side);
}

StemAngles stem_angles(const Vec3& axis, Side side) noexcept {
  const Vec3 n = on_side(axis, side);
  return {between(core::hypotenuse(n.x(), n.z()), n.y()), between(-n.x(), n.z())};
}

}  // namespace condyle::plan
