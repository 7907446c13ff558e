#include "sample/field.hpp"

#include <cmath>

namespace condyle::sample {
namespace {

/// Unit vector, or zero where there is no direction: on the skeleton itself, far from any surface.
Vec3 direction(const Vec3& v) noexcept {
  const double length = v.norm();
  return length > 0 ? Vec3(v / length) : Vec3(Vec3::Zero());
}

FieldValue negated(const FieldValue& a) noexcept {
  return {-a.value, -a.gradient};
}

}  // namespace

Box box_around(std::span<const Ball> balls) {
  Box box = {balls[0].centre, balls[0].centre};
  for (const Ball& b : balls) {
    box.low = box.low.cwiseMin(b.centre - Vec3::Constant(b.radius));
    box.high = box.high.cwiseMax(b.centre + Vec3::Constant(b.radius));
  }
  return box;
}

FieldValue ball(const Ball& a, const Vec3& p) noexcept {
  const Vec3 away = p - a.centre;
  return {away.norm() - a.radius, direction(away)};
}

FieldValue bar(const Ball& a, const Ball& b, const Vec3& p) noexcept {
  const Vec3 along = b.centre - a.centre;
  const double t = (p - a.centre).dot(along) / along.squaredNorm();
  if (t <= 0) return ball(a, p);
  if (t >= 1) return ball(b, p);
  const Vec3 away = p - (a.centre + t * along);
  const double taper = b.radius - a.radius;
  return {away.norm() - (a.radius + t * taper), direction(away) - (taper / along.squaredNorm()) * along};
}

FieldValue plate(const Ball& a, const Ball& b, const Ball& c, const Vec3& p) noexcept {
  const Vec3 ab = b.centre - a.centre, ac = c.centre - a.centre, ap = p - a.centre;
  const Vec3 normal = ab.cross(ac);
  const double area2 = normal.squaredNorm();
  // Gradients of the barycentric coordinates of b and c: p's shadow in the plate is a + v ab + w ac.
  const Vec3 grad_v = ac.cross(normal) / area2, grad_w = normal.cross(ab) / area2;
  const double v = ap.dot(grad_v), w = ap.dot(grad_w);
  FieldValue nearest = bar(a, b, p);
  const auto keep_nearer = [&](const FieldValue& other) {
    if (other.value < nearest.value) nearest = other;
  };
  keep_nearer(bar(b, c, p));
  keep_nearer(bar(c, a, p));
  if (v > 0 && w > 0 && v + w < 1) {
    const double rise_b = b.radius - a.radius, rise_c = c.radius - a.radius;
    const double length = std::sqrt(area2), height = ap.dot(normal) / length;
    keep_nearer({std::abs(height) - (a.radius + v * rise_b + w * rise_c),
                 (std::copysign(1.0, height) / length) * normal - (rise_b * grad_v + rise_c * grad_w)});
  }
  return nearest;
}

FieldValue tube(const Circle& along, double tube_radius, const Vec3& p) noexcept {
  const Vec3 from_centre = p - along.centre;
  const Vec3 outward = direction(from_centre - from_centre.dot(along.axis) * along.axis);
  const Vec3 away = from_centre - along.radius * outward;
  return {away.norm() - tube_radius, direction(away)};
}

FieldValue half_space(const Vec3& normal, double offset, const Vec3& p) noexcept {
  return {p.dot(normal) - offset, normal};
}

FieldValue joined(const FieldValue& a, const FieldValue& b, double blend) noexcept {
  const FieldValue& low = a.value <= b.value ? a : b;
  const FieldValue& high = a.value <= b.value ? b : a;
  const double h = 1 - (high.value - low.value) / blend;
  if (h <= 0) return low;
  // d/dp [low - blend h^2 / 4] with dh = (d low - d high) / blend.
  return {low.value - blend * h * h / 4, (1 - h / 2) * low.gradient + (h / 2) * high.gradient};
}

FieldValue joined(const FieldValue& a, const FieldValue& b, const FieldValue& blend) noexcept {
  FieldValue seam = joined(a, b, blend.value);
  // With x = |a - b| / blend < 1: d/dblend [-blend (1 - x)^2 / 4] = -(1 - x^2) / 4.
  const double x = std::abs(a.value - b.value) / blend.value;
  if (x < 1) seam.gradient -= (1 - x * x) / 4 * blend.gradient;
  return seam;
}

FieldValue common(const FieldValue& a, const FieldValue& b, double blend) noexcept {
  return negated(joined(negated(a), negated(b), blend));
}

FieldValue without(const FieldValue& a, const FieldValue& b, double blend) noexcept {
  return common(a, negated(b), blend);
}

}  // namespace condyle::sample
