#pragma once

#include "core/predicates.hpp"
#include "mesh/triangle_intersection.hpp"

/// One ray from the origin through one point, against one triangle. docs/mathematics/02-radial-method.md.

namespace condyle::radial {

/// How the ray from the origin through v meets a triangle.
///
///          c                 v . N > 0: the ray leaves the solid (out)
///        /   \               v . N < 0: it enters             (in)
///   0 --/--x--\-----> v      beyond: x lies between 0 and v
///      a ----- b
struct RayCrossing {
  core::Sign outwards =
      core::Sign::zero;       ///< sign of v . N where the ray crosses the triangle; zero where it does not
  bool before_point = false;  ///< the crossing lies between the origin and v
  bool point_on_triangle = false;
};

/// Side of the plane through the origin, a and b on which v lies, never zero but where a, b and the origin
/// are on a line: a zero is broken by moving v by eps x + eps^2 y + eps^3 z, the same infinitesimal shift for
/// every edge. The neighbour across the edge has (b, a) and gets the negative, always. `touched` is set
/// where the sign was exactly zero.
inline core::Sign ray_side(const Vec3& v, const Vec3& a, const Vec3& b, bool& touched) noexcept {
  const auto filtered = core::filtered_determinant(v, a, b);
  if (filtered.certain) return core::sign_of(filtered.value);
  core::Sign side = core::exact::orientation(v, a, b);
  if (side != core::Sign::zero) return side;
  touched = true;
  side = core::determinant_2x2(a.y(), a.z(), b.y(), b.z());
  if (side == core::Sign::zero) side = core::determinant_2x2(a.z(), a.x(), b.z(), b.x());
  if (side == core::Sign::zero) side = core::determinant_2x2(a.x(), a.y(), b.x(), b.y());
  return side;
}

/// A triangle whose plane holds the origin is never crossed: its three sides then never have one sign, unless
/// the origin lies in the triangle, which a table refuses.
inline RayCrossing ray_crossing(const Vec3& v, const Vec3& a, const Vec3& b, const Vec3& c) noexcept {
  RayCrossing crossing;
  bool touched = false;
  const core::Sign ab = ray_side(v, a, b, touched);
  const core::Sign bc = ray_side(v, b, c, touched);
  if (!touched && ab != bc) return crossing;
  const core::Sign ca = ray_side(v, c, a, touched);
  if (touched) {
    crossing.point_on_triangle =
        core::orientation(a, b, c, v) == core::Sign::zero && mesh::contains_coplanar({a, b, c}, v);
  }
  if (ab != bc || bc != ca || ab == core::Sign::zero) return crossing;

  // All sides agree: v . N, their sum, has their sign. The crossing lies at D / (v . N) of the way to v.
  if (core::orientation(a, b, c) != ab) return crossing;
  crossing.outwards = ab;
  const core::Sign past = core::orientation(a, b, c, v);  // sign of v . N - D
  crossing.before_point = past == ab;
  crossing.point_on_triangle |= past == core::Sign::zero;
  return crossing;
}

}  // namespace condyle::radial
