#include "sample/field.hpp"

#include <algorithm>
#include <cmath>

namespace condyle::sample {
namespace {

/// Unit vector, or zero if there is no direction: on the skeleton itself, far from any surface.
Vec3 direction(const Vec3& v) noexcept {
  const double length = v.norm();
  return length > 0 ? Vec3(v / length) : Vec3(Vec3::Zero());
}

/// The place of a bar between two balls that a point is held against.
struct BarFoot {
  Vec3 away;
  double radius;
  Vec3 along;
  double length2, taper;  ///< no taper at either end

  BarFoot(const Ball& a, const Ball& b, const Vec3& p) noexcept
      : along(b.centre - a.centre), length2(along.squaredNorm()), taper(0) {
    const double t = (p - a.centre).dot(along) / length2;
    if (t <= 0) {
      away = p - a.centre, radius = a.radius;
    } else if (t >= 1) {
      away = p - b.centre, radius = b.radius;
    } else {
      taper = b.radius - a.radius;
      away = p - (a.centre + t * along), radius = a.radius + t * taper;
    }
  }
  double value() const noexcept { return away.norm() - radius; }
  Vec3 gradient() const noexcept { return direction(away) - (taper / length2) * along; }
};

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
  const BarFoot foot(a, b, p);
  return {foot.value(), foot.gradient()};
}

Plate::Plate(const Ball& a, const Ball& b, const Ball& c) noexcept : a_(a), b_(b), c_(c) {
  const Vec3 ab = b.centre - a.centre, ac = c.centre - a.centre;
  normal_ = ab.cross(ac);
  const double area2 = normal_.squaredNorm();
  length_ = std::sqrt(area2);
  upwards_ = normal_ / length_;
  grad_v_ = ac.cross(normal_) / area2;
  grad_w_ = normal_.cross(ab) / area2;
  disc_.centre = (a.centre + b.centre + c.centre) / 3;
  for (const Ball& corner : {a, b, c}) {
    disc_.radius = std::max(disc_.radius, (corner.centre - disc_.centre).norm());
    thickest_ = std::max(thickest_, corner.radius);
  }
}

FieldValue Plate::operator()(const Vec3& p) const noexcept {
  const Vec3 ap = p - a_.centre;
  const double v = ap.dot(grad_v_), w = ap.dot(grad_w_);
  // Gradients cost divisions: only the nearest part's is asked for.
  const BarFoot sides[3] = {{a_, b_, p}, {b_, c_, p}, {c_, a_, p}};
  const double values[3] = {sides[0].value(), sides[1].value(), sides[2].value()};
  int nearest = 0;
  for (int k = 1; k < 3; ++k) {
    if (values[k] < values[nearest]) nearest = k;
  }
  if (v > 0 && w > 0 && v + w < 1) {
    const double rise_b = b_.radius - a_.radius, rise_c = c_.radius - a_.radius;
    const double height = ap.dot(normal_) / length_;
    const double value = std::abs(height) - (a_.radius + v * rise_b + w * rise_c);
    if (value < values[nearest]) {
      return {value,
              (std::copysign(1.0, height) / length_) * normal_ - (rise_b * grad_v_ + rise_c * grad_w_)};
    }
  }
  return {values[nearest], sides[nearest].gradient()};
}

bool Plate::is_above(double value, const Vec3& p) const noexcept {
  const double reach = value + thickest_ + rounding_mm;
  if (reach < 0) return true;
  const Vec3 away = p - disc_.centre;
  const double height = away.dot(upwards_), height2 = height * height, across2 = away.squaredNorm() - height2;
  if (across2 <= disc_.radius * disc_.radius) return height2 > reach * reach;
  const double beyond = std::sqrt(across2) - disc_.radius;
  return height2 + beyond * beyond > reach * reach;
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
