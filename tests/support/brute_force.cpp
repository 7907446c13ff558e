#include "support/brute_force.hpp"

#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <optional>

namespace condyle::test {
namespace {

using Rational = boost::multiprecision::cpp_rational;
using Exact3 = std::array<Rational, 3>;

Exact3 exact(const Vec3& p) {
  return {Rational(p.x()), Rational(p.y()), Rational(p.z())};
}
Exact3 minus(const Exact3& a, const Exact3& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
Exact3 cross(const Exact3& a, const Exact3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Rational dot(const Exact3& a, const Exact3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// Whether point p, known to lie in the triangle's plane, lies in the closed triangle.
bool holds(const std::array<Exact3, 3>& t, const Exact3& normal, const Exact3& p) {
  for (int k = 0; k < 3; ++k) {
    if (dot(cross(minus(t[(k + 1) % 3], t[k]), minus(p, t[k])), normal) < 0) return false;
  }
  return true;
}

/// Closed segments p q and r s in one plane with the given normal.
bool segments_meet(const Exact3& p, const Exact3& q, const Exact3& r, const Exact3& s, const Exact3& normal) {
  const auto side = [&](const Exact3& a, const Exact3& b, const Exact3& c) {
    return dot(cross(minus(b, a), minus(c, a)), normal).sign();
  };
  const int pr = side(p, q, r), ps = side(p, q, s), rp = side(r, s, p), rq = side(r, s, q);
  if (pr == 0 && ps == 0) {
    const Exact3 along = minus(q, p);
    const Rational length = dot(along, along), a = dot(minus(r, p), along), b = dot(minus(s, p), along);
    return std::max(a, b) >= 0 && std::min(a, b) <= length;
  }
  return pr * ps <= 0 && rp * rq <= 0;
}

/// Whether the closed segment p q meets the closed triangle.
bool segment_meets(const Exact3& p, const Exact3& q, const std::array<Exact3, 3>& t) {
  const Exact3 normal = cross(minus(t[1], t[0]), minus(t[2], t[0]));
  const Rational at_p = dot(minus(p, t[0]), normal), at_q = dot(minus(q, t[0]), normal);
  if (at_p.sign() * at_q.sign() > 0) return false;
  if (at_p == 0 && at_q == 0) {
    if (holds(t, normal, p) || holds(t, normal, q)) return true;
    for (int k = 0; k < 3; ++k) {
      if (segments_meet(p, q, t[k], t[(k + 1) % 3], normal)) return true;
    }
    return false;
  }
  const Rational s = at_p / (at_p - at_q);
  const Exact3 along = minus(q, p);
  return holds(t, normal, {p[0] + s * along[0], p[1] + s * along[1], p[2] + s * along[2]});
}

bool intersect(const std::array<Exact3, 3>& a, const std::array<Exact3, 3>& b) {
  for (int k = 0; k < 3; ++k) {
    if (segment_meets(a[k], a[(k + 1) % 3], b) || segment_meets(b[k], b[(k + 1) % 3], a)) return true;
  }
  return false;
}

/// Signed crossings of the ray from p along d; empty where it meets an edge or a vertex.
std::optional<int> crossings(const std::vector<std::array<Exact3, 3>>& triangles, const Exact3& p,
                             const Exact3& d) {
  int sum = 0;
  for (const auto& t : triangles) {
    std::array<int, 3> side;
    for (int k = 0; k < 3; ++k) side[k] = dot(d, cross(minus(t[k], p), minus(t[(k + 1) % 3], p))).sign();
    const bool all_in = side[0] >= 0 && side[1] >= 0 && side[2] >= 0;
    const bool all_out = side[0] <= 0 && side[1] <= 0 && side[2] <= 0;
    if (!all_in && !all_out) continue;
    if (side[0] * side[1] * side[2] == 0) return std::nullopt;
    const Exact3 normal = cross(minus(t[1], t[0]), minus(t[2], t[0]));
    const int towards = dot(d, normal).sign();
    if (dot(minus(t[0], p), normal).sign() * towards > 0) sum += towards;
  }
  return sum;
}

}  // namespace

BruteWinding winding_number(const TriMesh& mesh, const Vec3& point) {
  const Exact3 p = exact(point);
  std::vector<std::array<Exact3, 3>> triangles;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const std::array<Exact3, 3> corners = {exact(mesh.corner(t, 0)), exact(mesh.corner(t, 1)),
                                           exact(mesh.corner(t, 2))};
    const Exact3 normal = cross(minus(corners[1], corners[0]), minus(corners[2], corners[0]));
    // A triangle without area is never crossed; collinear with p, no direction would seem to miss it.
    if (dot(normal, normal) == 0) continue;
    if (dot(minus(p, corners[0]), normal) == 0 && holds(corners, normal, p)) return {true, 0};
    triangles.push_back(corners);
  }
  for (int attempt = 0;; ++attempt) {
    const Exact3 d = {Rational(1000 + 7 * attempt), Rational(313 - 11 * attempt), Rational(71 + 3 * attempt)};
    if (const auto sum = crossings(triangles, p, d)) return {false, *sum};
  }
}

bool triangles_intersect(const std::array<Vec3, 3>& a, const std::array<Vec3, 3>& b) {
  return intersect({exact(a[0]), exact(a[1]), exact(a[2])}, {exact(b[0]), exact(b[1]), exact(b[2])});
}

std::vector<std::pair<Index, Index>> intersecting_pairs(const TriMesh& a, const TriMesh& b) {
  std::vector<std::pair<Index, Index>> pairs;
  for (Index i = 0; i < a.triangles.size(); ++i) {
    for (Index j = 0; j < b.triangles.size(); ++j) {
      if (triangles_intersect({a.corner(i, 0), a.corner(i, 1), a.corner(i, 2)},
                              {b.corner(j, 0), b.corner(j, 1), b.corner(j, 2)})) {
        pairs.emplace_back(i, j);
      }
    }
  }
  return pairs;
}

}  // namespace condyle::test
