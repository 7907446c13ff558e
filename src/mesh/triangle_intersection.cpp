#include "mesh/triangle_intersection.hpp"

#include <algorithm>
#include <optional>

#include "core/predicates.hpp"

namespace condyle::mesh {
namespace {

/// Points of one plane seen along a coordinate axis along which the triangle keeps an area: (i, j) are the
/// coordinates kept.
struct Projection {
  int i, j;

  core::Sign turn(const Vec3& p, const Vec3& q, const Vec3& r) const noexcept {
    return core::orientation_2d(p[i], p[j], q[i], q[j], r[i], r[j]);
  }
};

std::optional<Projection> projection_of(const TriangleCorners& t) noexcept {
  for (const Projection onto : {Projection{0, 1}, Projection{1, 2}, Projection{2, 0}}) {
    if (onto.turn(t[0], t[1], t[2]) != core::Sign::zero) return onto;
  }
  return std::nullopt;
}

bool contains(const Projection& onto, const TriangleCorners& t, const Vec3& p) noexcept {
  bool left = false, right = false;
  for (int k = 0; k < 3; ++k) {
    const core::Sign side = onto.turn(t[k], t[(k + 1) % 3], p);
    left |= side == core::Sign::positive;
    right |= side == core::Sign::negative;
  }
  return !(left && right);
}

/// Closed segments p q and r s, seen in projection.
bool segments_meet(const Projection& onto, const Vec3& p, const Vec3& q, const Vec3& r,
                   const Vec3& s) noexcept {
  const core::Sign at_r = onto.turn(p, q, r), at_s = onto.turn(p, q, s);
  const core::Sign at_p = onto.turn(r, s, p), at_q = onto.turn(r, s, q);
  if (at_r == core::Sign::zero && at_s == core::Sign::zero && at_p == core::Sign::zero &&
      at_q == core::Sign::zero) {
    const auto overlap = [&](int k) {
      return std::max(std::min(p[k], q[k]), std::min(r[k], s[k])) <=
             std::min(std::max(p[k], q[k]), std::max(r[k], s[k]));
    };
    return overlap(onto.i) && overlap(onto.j);
  }
  return at_r * at_s != core::Sign::positive && at_p * at_q != core::Sign::positive;
}

/// A segment in the triangle's plane.
bool coplanar_segment_meets(const Projection& onto, const Vec3& p, const Vec3& q,
                            const TriangleCorners& t) noexcept {
  if (contains(onto, t, p)) return true;
  for (int k = 0; k < 3; ++k) {
    if (segments_meet(onto, p, q, t[k], t[(k + 1) % 3])) return true;
  }
  return false;
}

/// Whether the line through p and q, whose ends are not both in t's plane and not on one side of it, meets t.
bool line_stabs(const Vec3& p, const Vec3& q, const TriangleCorners& t) noexcept {
  bool left = false, right = false;
  for (int k = 0; k < 3; ++k) {
    const core::Sign side = core::orientation(p, q, t[k], t[(k + 1) % 3]);
    left |= side == core::Sign::positive;
    right |= side == core::Sign::negative;
    if (left && right) return false;
  }
  return true;
}

struct Sides {
  std::array<core::Sign, 3> of;  // corner k's side of the other triangle's plane

  bool one_sided() const noexcept { return of[0] == of[1] && of[1] == of[2] && of[0] != core::Sign::zero; }
};

Sides sides(const TriangleCorners& corners, const TriangleCorners& plane) noexcept {
  return {{core::orientation(plane[0], plane[1], plane[2], corners[0]),
           core::orientation(plane[0], plane[1], plane[2], corners[1]),
           core::orientation(plane[0], plane[1], plane[2], corners[2])}};
}

bool an_edge_meets(const TriangleCorners& edges, const Sides& side, const TriangleCorners& t,
                   const Projection& onto_t) noexcept {
  for (int k = 0; k < 3; ++k) {
    const int next = (k + 1) % 3;
    if (side.of[k] * side.of[next] == core::Sign::positive) continue;
    const bool in_plane = side.of[k] == core::Sign::zero && side.of[next] == core::Sign::zero;
    if (in_plane ? coplanar_segment_meets(onto_t, edges[k], edges[next], t)
                 : line_stabs(edges[k], edges[next], t)) {
      return true;
    }
  }
  return false;
}

}  // namespace

bool contains_coplanar(const TriangleCorners& t, const Vec3& p) noexcept {
  const auto onto = projection_of(t);
  return onto && contains(*onto, t, p);
}

bool triangles_intersect(const TriangleCorners& a, const TriangleCorners& b) noexcept {
  const Sides of_b = sides(b, a);
  if (of_b.one_sided()) return false;
  const Sides of_a = sides(a, b);
  if (of_a.one_sided()) return false;
  const auto onto_a = projection_of(a), onto_b = projection_of(b);
  if (!onto_a || !onto_b) return false;
  return an_edge_meets(b, of_b, a, *onto_a) || an_edge_meets(a, of_a, b, *onto_b);
}

}  // namespace condyle::mesh
