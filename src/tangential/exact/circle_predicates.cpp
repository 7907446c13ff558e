#include "tangential/exact/circle_predicates.hpp"

#include "core/exact_integers.hpp"

namespace condyle::tangential {
namespace {

using core::exact::Integer;

/// An end in homogeneous coordinates, (x / w, y / w) with w > 0: quadratic over linear.
struct ExactEnd {
  Integer x, y, w;
};

ExactEnd exact_end(const Integer* lower, const Integer* upper, const Integer& height) {
  const Integer above = upper[2] - height, below = height - lower[2];
  return {lower[0] * above + upper[0] * below, lower[1] * above + upper[1] * below, upper[2] - lower[2]};
}

bool exact_end_is_inside(const Circle& circle, const CircleCut::End& end) {
  const Vec3 &a = *end.lower, &b = *end.upper, &v = circle.point;
  const auto n = core::exact::to_integers<9>({a.x(), a.y(), a.z(), b.x(), b.y(), b.z(), v.x(), v.y(), v.z()});
  const ExactEnd e = exact_end(&n[0], &n[3], n[8]);
  return e.x * e.x + e.y * e.y < (n[6] * n[6] + n[7] * n[7]) * (e.w * e.w);
}

bool exact_has_chord(const Circle& circle, const CircleCut& cut) {
  const Vec3 &a = *cut.p.lower, &b = *cut.p.upper, &c = *cut.q.lower, &d = *cut.q.upper, &v = circle.point;
  const auto n = core::exact::to_integers<15>({a.x(), a.y(), a.z(), b.x(), b.y(), b.z(), c.x(), c.y(), c.z(),
                                               d.x(), d.y(), d.z(), v.x(), v.y(), v.z()});
  const ExactEnd p = exact_end(&n[0], &n[3], n[14]), q = exact_end(&n[6], &n[9], n[14]);
  // (q - p) times both denominators.
  const Integer x = p.w * q.x - q.w * p.x, y = p.w * q.y - q.w * p.y;
  if (p.x * x + p.y * y >= 0 || q.x * x + q.y * y <= 0) return false;
  const Integer cross = p.x * q.y - p.y * q.x;
  return cross * cross < (n[12] * n[12] + n[13] * n[13]) * (x * x + y * y);
}

}  // namespace

bool end_is_inside(const Circle& circle, const CircleCut::End& end, TangentialWork& work) {
  // 12u M in x and y move |end|^2 by 48u M^2; the sums of squares add 12u M^2.
  const double value = (end.x * end.x + end.y * end.y) - circle.squared_radius;
  if (std::abs(value) > 96 * core::rounding_unit * (circle.scale * circle.scale)) return value < 0;
  ++work.exact_decisions;
  return exact_end_is_inside(circle, end);
}

bool has_chord(const Circle& circle, const CircleCut& cut, TangentialWork& work) {
  const auto& [p, q, triangle] = cut;
  const double dx = q.x - p.x, dy = q.y - p.y;
  const double at_p = p.x * dx + p.y * dy, at_q = q.x * dx + q.y * dy;
  // The difference of two ends errs by 26u M in x and y: products by 26u * 2 M^2 + 12u * 4 M^2 + 8u M^2.
  const double squared_scale = circle.scale * circle.scale,
               dot_bound = 128 * core::rounding_unit * squared_scale;
  if (at_p > dot_bound || at_q < -dot_bound) return false;
  // rho^2 |q - p|^2 (2 M^2, and 8 M^2 off by 208u M^2) and (p x q)^2 (4 M^4, of 2 M^2 off by 52u M^2): 416u +
  // 208u, and at most 150u M^4 for the products.
  const double cross = p.x * q.y - p.y * q.x;
  const double discriminant = circle.squared_radius * (dx * dx + dy * dy) - cross * cross;
  const double discriminant_bound = 1024 * core::rounding_unit * squared_scale * squared_scale;
  if (discriminant < -discriminant_bound) return false;
  if (at_p < -dot_bound && at_q > dot_bound && discriminant > discriminant_bound) return true;
  ++work.exact_decisions;
  return exact_has_chord(circle, cut);
}

core::Sign side_of_end(const Circle& circle, const CircleCut::End& end, TangentialWork& work) {
  // 12u M of the end, times |x| and |y| of the point: 24u M^2, and 4u M^2 for the products.
  const double value = circle.point.x() * end.y - circle.point.y() * end.x;
  if (std::abs(value) > 64 * core::rounding_unit * (circle.scale * circle.scale)) return core::sign_of(value);
  ++work.exact_decisions;
  // (point - centre) x (lower - centre) . (upper - centre) is that product times the height of the edge.
  const core::Sign sign = core::orientation(circle.centre(), circle.point, *end.lower, *end.upper);
  return sign == core::Sign::zero ? core::Sign::negative : sign;
}

}  // namespace condyle::tangential
