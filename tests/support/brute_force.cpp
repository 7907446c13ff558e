#include "support/brute_force.hpp"

#include <algorithm>
#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>

namespace condyle::test {
namespace {

namespace mp = boost::multiprecision;
/// Integers of any size; up to these bits without allocation.
using Integer = mp::number<mp::cpp_int_backend<512, 0>, mp::et_off>;
using Exact3 = std::array<Integer, 3>;

/// Finite doubles are integers times a power of two. All coordinates of a question as integers, times one and
/// the same power: every question here is one of signs, which a common factor does not change.
class Grid {
 public:
  void include(const Vec3& p) {
    for (const double x : {p.x(), p.y(), p.z()}) {
      if (x != 0) exponent_ = std::min(exponent_, std::ilogb(x) - std::numeric_limits<double>::digits + 1);
    }
  }
  void include(const TriMesh& mesh) {
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v) include(mesh.vertices[v]);
  }
  Exact3 exact(const Vec3& p) const { return {exact(p.x()), exact(p.y()), exact(p.z())}; }

 private:
  Integer exact(double x) const {
    if (x == 0) return 0;
    constexpr int digits = std::numeric_limits<double>::digits;
    const int below = std::ilogb(x) - digits + 1;
    return Integer(static_cast<std::int64_t>(std::ldexp(x, -below))) << (below - exponent_);
  }

  int exponent_ = std::numeric_limits<int>::max();
};

Exact3 minus(const Exact3& a, const Exact3& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
Exact3 cross(const Exact3& a, const Exact3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Exact3 times(const Integer& factor, const Exact3& a) {
  return {factor * a[0], factor * a[1], factor * a[2]};
}
Integer dot(const Exact3& a, const Exact3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// Whether the point p / denominator, known to lie in the triangle's plane, lies in the closed triangle;
/// denominator > 0.
bool holds(const std::array<Exact3, 3>& t, const Exact3& normal, const Exact3& p,
           const Integer& denominator = 1) {
  for (int k = 0; k < 3; ++k) {
    const Exact3 from_corner = minus(p, times(denominator, t[k]));
    if (dot(cross(minus(t[(k + 1) % 3], t[k]), from_corner), normal) < 0) return false;
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
    const Integer length = dot(along, along), a = dot(minus(r, p), along), b = dot(minus(s, p), along);
    return std::max(a, b) >= 0 && std::min(a, b) <= length;
  }
  return pr * ps <= 0 && rp * rq <= 0;
}

/// Whether the closed segment p q meets the closed triangle.
bool segment_meets(const Exact3& p, const Exact3& q, const std::array<Exact3, 3>& t) {
  const Exact3 normal = cross(minus(t[1], t[0]), minus(t[2], t[0]));
  const Integer at_p = dot(minus(p, t[0]), normal), at_q = dot(minus(q, t[0]), normal);
  if (at_p.sign() * at_q.sign() > 0) return false;
  if (at_p == 0 && at_q == 0) {
    if (holds(t, normal, p) || holds(t, normal, q)) return true;
    for (int k = 0; k < 3; ++k) {
      if (segments_meet(p, q, t[k], t[(k + 1) % 3], normal)) return true;
    }
    return false;
  }
  // p + at_p / (at_p - at_q) (q - p)
  const bool is_from_above = at_p > at_q;
  const Integer denominator = is_from_above ? at_p - at_q : at_q - at_p;
  const Exact3 shift = times(is_from_above ? at_p : Integer(-at_p), minus(q, p));
  const Exact3 base = times(denominator, p);
  return holds(t, normal, {base[0] + shift[0], base[1] + shift[1], base[2] + shift[2]}, denominator);
}

bool has_area(const std::array<Exact3, 3>& t) {
  const Exact3 normal = cross(minus(t[1], t[0]), minus(t[2], t[0]));
  return dot(normal, normal) != 0;
}

/// A triangle without area meets nothing: its points are those of its neighbours.
bool intersect(const std::array<Exact3, 3>& a, const std::array<Exact3, 3>& b) {
  if (!has_area(a) || !has_area(b)) return false;
  for (int k = 0; k < 3; ++k) {
    if (segment_meets(a[k], a[(k + 1) % 3], b) || segment_meets(b[k], b[(k + 1) % 3], a)) return true;
  }
  return false;
}

std::array<Exact3, 3> exact_corners(const Grid& grid, const TriMesh& mesh, std::size_t t) {
  return {grid.exact(mesh.corner(t, 0)), grid.exact(mesh.corner(t, 1)), grid.exact(mesh.corner(t, 2))};
}

/// Signed crossings of the ray from p along d; empty if it meets an edge or a vertex.
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
  Grid grid;
  grid.include(mesh);
  grid.include(point);
  const Exact3 p = grid.exact(point);
  std::vector<std::array<Exact3, 3>> triangles;
  triangles.reserve(mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const std::array<Exact3, 3> corners = exact_corners(grid, mesh, t);
    const Exact3 normal = cross(minus(corners[1], corners[0]), minus(corners[2], corners[0]));
    // A triangle without area is never crossed; collinear with p, no direction would seem to miss it.
    if (dot(normal, normal) == 0) continue;
    if (dot(minus(p, corners[0]), normal) == 0 && holds(corners, normal, p)) return {true, 0};
    triangles.push_back(corners);
  }
  for (int attempt = 0;; ++attempt) {
    const Exact3 d = {Integer(1000 + 7 * attempt), Integer(313 - 11 * attempt), Integer(71 + 3 * attempt)};
    if (const auto sum = crossings(triangles, p, d)) return {false, *sum};
  }
}

bool triangles_intersect(const std::array<Vec3, 3>& a, const std::array<Vec3, 3>& b) {
  Grid grid;
  for (const auto& triangle : {a, b})
    for (const Vec3& p : triangle) grid.include(p);
  return intersect({grid.exact(a[0]), grid.exact(a[1]), grid.exact(a[2])},
                   {grid.exact(b[0]), grid.exact(b[1]), grid.exact(b[2])});
}

std::vector<std::pair<Index, Index>> intersecting_pairs(const TriMesh& a, const TriMesh& b) {
  Grid grid;
  grid.include(a);
  grid.include(b);
  std::vector<std::array<Exact3, 3>> others;
  others.reserve(b.triangles.size());
  for (Index j = 0; j < b.triangles.size(); ++j) others.push_back(exact_corners(grid, b, j));
  std::vector<std::pair<Index, Index>> pairs;
  for (Index i = 0; i < a.triangles.size(); ++i) {
    const std::array<Exact3, 3> corners = exact_corners(grid, a, i);
    for (Index j = 0; j < others.size(); ++j) {
      if (intersect(corners, others[j])) pairs.emplace_back(i, j);
    }
  }
  return pairs;
}

}  // namespace condyle::test
