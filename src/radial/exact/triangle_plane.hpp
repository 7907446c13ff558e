#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "condyle/pose.hpp"
#include "core/predicates.hpp"

namespace condyle::radial {

namespace triangle_plane {

/// Beyond these, products of the conditions could overflow or vanish.
inline constexpr double least_square = 0x1p-240, greatest_square = 0x1p240;
/// See scaled_normal: squares of its two 8s.
inline constexpr double most_sliver = 64, most_oblique = 64;

inline double dot(const Vec3& a, const Vec3& b) noexcept {
  return (a.x() * b.x() + a.y() * b.y()) + a.z() * b.z();
}

inline double as_two_floats(double value) noexcept {
  const auto high = static_cast<float>(value);
  return static_cast<double>(high) +
         static_cast<double>(static_cast<float>(value - static_cast<double>(high)));
}

}  // namespace triangle_plane

/// N / |D| of a triangle's plane v . N = D, for ways along rays: | v . N | / |D| is |v| over the radius at
/// which the ray through v meets the plane. Each component is the sum of two floats, as tables keep it. NaN
/// for a triangle of which that would not be known well enough.
///
/// With u = 2^-53, (b - a) x (c - a) errs by at most 6u |b - a| |c - a|, and D, its product with a, by 4u |a|
/// |N| and what N errs by. The conditions are |b - a| |c - a| <= 8 |N| (no sliver) and |D| >= |N| max(|a|,
/// |b|, |c|) / 8: no ray through the triangle is more than 82.8 degrees off its normal. So N errs by 48u, D
/// by 416u, the quotient by 466u, of their size; two floats add 2^-49, a product with v 3u; and as that is at
/// least an eighth of its terms' size, the fraction | v . N | / |D| errs by less than 4000u, 4.5e-13, of
/// itself.
///
/// The same operations in the same order as measure_triangles() has them in vectors.
inline Vec3 scaled_normal(const Vec3& a, const Vec3& b, const Vec3& c) noexcept {
  using namespace triangle_plane;
  const Vec3 ab = b - a, ac = c - a;
  const Vec3 n(ab.y() * ac.z() - ab.z() * ac.y(), ab.z() * ac.x() - ab.x() * ac.z(),
               ab.x() * ac.y() - ab.y() * ac.x());
  const double nn = dot(n, n), offset = dot(a, n);
  const double furthest = std::max(dot(a, a), std::max(dot(b, b), dot(c, c)));
  const bool known = nn > least_square && nn < greatest_square &&
                     dot(ab, ab) * dot(ac, ac) <= most_sliver * nn &&
                     most_oblique * (offset * offset) >= furthest * nn;
  if (!known) return Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
  const double scale = std::abs(1 / offset);
  return {as_two_floats(n.x() * scale), as_two_floats(n.y() * scale), as_two_floats(n.z() * scale)};
}

/// Signed way from v along its ray, outwards positive, to the plane of a triangle that the ray crosses. NaN
/// where the plane's radius is more than twice that of v, or its normal NaN: otherwise within 1e-12 of
/// |v|.
inline double gap_to_plane(const Vec3& v, const Vec3& scaled_normal) noexcept {
  const double fraction = std::abs(triangle_plane::dot(v, scaled_normal));
  if (!(fraction >= 0.5)) return std::numeric_limits<double>::quiet_NaN();
  return (1 - fraction) / fraction * std::sqrt(triangle_plane::dot(v, v));
}

}  // namespace condyle::radial
