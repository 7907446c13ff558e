#include "tangential/exact/circle_crossing.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "condyle/angle.hpp"
#include "tangential/exact/arctangent.hpp"
#include "tangential/exact/circle_predicates.hpp"

namespace condyle::tangential {
namespace {

CircleCut::End cut_end(const Vec3& lower, const Vec3& upper, double height) noexcept {
  const double t = (height - lower.z()) / (upper.z() - lower.z());
  return {&lower, &upper, lower.x() + t * (upper.x() - lower.x()), lower.y() + t * (upper.y() - lower.y())};
}

/// The triangle cut at the circle's height; none if it lies above or below.
///
/// Corner k, the apex, is the only one on its side; counter-clockwise seen from outside k + 1 and k + 2 follow
/// it. With the apex above, the cut from edge (k, k + 1) to edge (k, k + 2) has the outside on its right; with
/// it below, the other way round.
std::optional<CircleCut> cut_at_height(const Circle& circle, const TriangleRef& t) noexcept {
  const double h = circle.point.z();
  const std::array<bool, 3> above = {t[0]->z() >= h, t[1]->z() >= h, t[2]->z() >= h};
  const int count = above[0] + above[1] + above[2];
  if (count == 0 || count == 3) return std::nullopt;
  const bool apex_above = count == 1;
  const std::size_t k = above[0] == apex_above ? 0 : above[1] == apex_above ? 1 : 2;
  const Vec3 &apex = *t[k], &next = *t[(k + 1) % 3], &last = *t[(k + 2) % 3];
  if (apex_above) return CircleCut{cut_end(next, apex, h), cut_end(last, apex, h), t};
  return CircleCut{cut_end(apex, last, h), cut_end(apex, next, h), t};
}

/// How the cut lies to the ray from the axis through the point, which is infinitely little ahead.
struct AcrossRay {
  core::Sign p, q;    ///< Sides of its ends: positive ahead.
  bool on_near_side;  ///< It crosses that ray, and not the opposite one.
  bool within;        ///< Where it crosses, it is nearer to the axis than the point.
};

/// The cut meets the line through axis and point at one point m. With s the side (of the triangle's plane,
/// which is the side of the cut) of the centre and v that of the point, m lies on the point's side of the axis
/// iff s is the side of p, and nearer than the point iff s and v are opposite.
AcrossRay across_ray(const Circle& circle, const CircleCut& cut, TangentialWork& work) {
  AcrossRay across{side_of_end(circle, cut.p, work), side_of_end(circle, cut.q, work), false, false};
  if (across.p == across.q) return across;
  const auto& [a, b, c] = cut.triangle;
  const core::Sign centre = core::orientation(*a, *b, *c, circle.centre());
  if (centre == core::Sign::zero) {
    // m is the centre itself: both halves of the cut leave it along one line.
    across.on_near_side = across.within = true;
  } else if (centre == across.p) {
    across.on_near_side = true;
    across.within = core::orientation(*a, *b, *c, circle.point) == -centre;
  }
  return across;
}

/// Angle from the point to (x, y) on its circle, put on the side where it is known to lie.
double angle_to(const Circle& circle, double x, double y, std::optional<core::Sign> side) noexcept {
  const Vec3& v = circle.point;
  const double angle = arctangent(v.x() * y - v.y() * x, v.x() * x + v.y() * y);
  constexpr double least = std::numeric_limits<double>::min();
  // Sides only matter close to the point: beyond a quarter turn the angle is far from 0 either way.
  if (std::abs(angle) > two_pi / 4) return angle;
  if (side == core::Sign::positive) return std::max(angle, least);
  if (side == core::Sign::negative) return std::min(angle, -least);
  return angle != 0 ? angle : least;
}

/// The circle's crossing with the cut from its end inside to its end outside.
///
/// |inside + t (outside - inside)|^2 = rho^2 with |inside| < rho: one root t > 0, from whichever form does
/// not subtract. Taken from the end inside, so that coincident cuts walked both ways give the same bits.
std::pair<double, double> crossing_point(const Circle& circle, double in_x, double in_y, double out_x,
                                         double out_y) noexcept {
  const double dx = out_x - in_x, dy = out_y - in_y;
  const double a = dx * dx + dy * dy, b = in_x * dx + in_y * dy;
  const double c = std::min(0.0, (in_x * in_x + in_y * in_y) - circle.squared_radius);
  const double root = std::sqrt(b * b - a * c);
  const double t = b > 0 ? -c / (b + root) : a > 0 ? (root - b) / a : 1;
  const double clamped = std::clamp(t, 0.0, 1.0);
  return {in_x + clamped * dx, in_y + clamped * dy};
}

}  // namespace

Circle circle_through(const Vec3& point, double scale) noexcept {
  return {point, point.x() * point.x() + point.y() * point.y(),
          std::max({scale, std::abs(point.x()), std::abs(point.y())})};
}

void add_crossings(const Circle& circle, const TriangleRef& triangle, Index number,
                   std::vector<CircleCrossing>& out, TangentialWork& work) {
  const auto cut = cut_at_height(circle, triangle);
  if (!cut) return;
  const bool p_inside = end_is_inside(circle, cut->p, work), q_inside = end_is_inside(circle, cut->q, work);
  if (p_inside && q_inside) return;
  if (p_inside != q_inside) {
    const AcrossRay across = across_ray(circle, *cut, work);
    const CircleCut::End &in = p_inside ? cut->p : cut->q, &away = p_inside ? cut->q : cut->p;
    const auto [x, y] = crossing_point(circle, in.x, in.y, away.x, away.y);
    std::optional<core::Sign> side;
    if (across.p == across.q) {
      side = across.p;
    } else if (across.on_near_side) {
      // Where the ray is met within the circle, the crossing lies beyond it, towards the end outside.
      side = across.within == p_inside ? across.q : across.p;
    }
    // The solid is on the left of the cut: where that leaves the disc, the circle enters the solid.
    out.push_back({angle_to(circle, x, y, side), p_inside ? Passage::enters : Passage::leaves, number});
    return;
  }
  if (!has_chord(circle, *cut, work)) return;
  const AcrossRay across = across_ray(circle, *cut, work);
  const double dx = cut->q.x - cut->p.x, dy = cut->q.y - cut->p.y, squared_length = dx * dx + dy * dy;
  const double t =
      squared_length > 0 ? std::clamp(-(cut->p.x * dx + cut->p.y * dy) / squared_length, 0.0, 1.0) : 0;
  const double foot_x = cut->p.x + t * dx, foot_y = cut->p.y + t * dy;
  const auto [first_x, first_y] = crossing_point(circle, foot_x, foot_y, cut->p.x, cut->p.y);
  const auto [second_x, second_y] = crossing_point(circle, foot_x, foot_y, cut->q.x, cut->q.y);
  std::optional<core::Sign> first_side, second_side;
  if (across.p == across.q) {
    first_side = second_side = across.p;
  } else if (across.on_near_side && across.within) {
    first_side = across.p, second_side = across.q;
  } else if (across.on_near_side) {
    // The whole chord lies on one side of the ray: that of its middle. Were that wrong by rounding, entry and
    // exit would still be neighbours in the order, so no other arc would change.
    first_side = second_side = circle.point.x() * foot_y - circle.point.y() * foot_x > 0
                                   ? core::Sign::positive
                                   : core::Sign::negative;
  }
  out.push_back({angle_to(circle, first_x, first_y, first_side), Passage::leaves, number});
  out.push_back({angle_to(circle, second_x, second_y, second_side), Passage::enters, number});
}

int outward_crossing(const Circle& circle, const TriangleRef& triangle, TangentialWork& work) {
  const auto cut = cut_at_height(circle, triangle);
  if (!cut) return 0;
  const AcrossRay across = across_ray(circle, *cut, work);
  if (!across.on_near_side || across.within) return 0;
  // Walked counter-clockwise, the cut has the solid between itself and the axis.
  return across.q == core::Sign::positive ? 1 : -1;
}

}  // namespace condyle::tangential
