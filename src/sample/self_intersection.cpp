#include "sample/self_intersection.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

#include "core/parallel.hpp"
#include "core/predicates.hpp"

namespace condyle::sample {
namespace {

using Corners = std::array<Vec3, 3>;

/// Orientation of a, b, c after dropping coordinate `axis`.
core::Sign orientation(const Vec3& a, const Vec3& b, const Vec3& c, int axis) noexcept {
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  return core::orientation_2d(a[u], a[v], b[u], b[v], c[u], c[v]);
}

/// An axis along which the triangle does not look like a line.
int viewing_axis(const Corners& t) noexcept {
  for (int axis = 0; axis < 2; ++axis) {
    if (orientation(t[0], t[1], t[2], axis) != core::Sign::zero) return axis;
  }
  return 2;
}

/// Closed segments in one plane, projected along `axis`.
bool coplanar_segments_meet(const Vec3& p, const Vec3& q, const Vec3& r, const Vec3& s, int axis) noexcept {
  const core::Sign pq_r = orientation(p, q, r, axis), pq_s = orientation(p, q, s, axis);
  const core::Sign rs_p = orientation(r, s, p, axis), rs_q = orientation(r, s, q, axis);
  if (pq_r == core::Sign::zero && pq_s == core::Sign::zero) {
    // On one line: they meet where their intervals do, in every coordinate.
    for (int k = 0; k < 3; ++k) {
      if (std::max(p[k], q[k]) < std::min(r[k], s[k]) || std::max(r[k], s[k]) < std::min(p[k], q[k]))
        return false;
    }
    return true;
  }
  return pq_r * pq_s != core::Sign::positive && rs_p * rs_q != core::Sign::positive;
}

/// A closed segment in the plane of a closed triangle.
bool coplanar_segment_meets(const Vec3& p, const Vec3& q, const Corners& t) noexcept {
  const int axis = viewing_axis(t);
  const core::Sign side[3] = {orientation(t[0], t[1], p, axis), orientation(t[1], t[2], p, axis),
                              orientation(t[2], t[0], p, axis)};
  const bool has_left = std::find(side, side + 3, core::Sign::positive) != side + 3;
  const bool has_right = std::find(side, side + 3, core::Sign::negative) != side + 3;
  if (!(has_left && has_right)) return true;
  for (int k = 0; k < 3; ++k) {
    if (coplanar_segments_meet(p, q, t[k], t[(k + 1) % 3], axis)) return true;
  }
  return false;
}

/// A closed segment and a closed triangle.
bool segment_meets(const Vec3& p, const Vec3& q, const Corners& t) noexcept {
  const core::Sign at_p = core::orientation(t[0], t[1], t[2], p),
                   at_q = core::orientation(t[0], t[1], t[2], q);
  if (at_p == core::Sign::zero && at_q == core::Sign::zero) return coplanar_segment_meets(p, q, t);
  if (at_p == at_q) return false;
  bool has_left = false, has_right = false;
  for (int k = 0; k < 3; ++k) {
    const core::Sign side = core::orientation(p, q, t[k], t[(k + 1) % 3]);
    has_left |= side == core::Sign::positive;
    has_right |= side == core::Sign::negative;
  }
  return !(has_left && has_right);
}

/// Whether triangles without a common corner meet.
bool apart_triangles_meet(const Corners& s, const Corners& t) noexcept {
  for (int k = 0; k < 3; ++k) {
    if (segment_meets(s[k], s[(k + 1) % 3], t) || segment_meets(t[k], t[(k + 1) % 3], s)) return true;
  }
  return false;
}

/// Whether two triangles with one common corner, given first, meet elsewhere. What they share is convex: if
/// it is more than the corner, it reaches from there to a side opposite the corner.
bool fans_meet(const Corners& s, const Corners& t) noexcept {
  return segment_meets(s[1], s[2], t) || segment_meets(t[1], t[2], s);
}

/// Whether two triangles with a common edge, given first in both, meet elsewhere: folded flat onto each
/// other.
bool folded(const Corners& s, const Vec3& other) noexcept {
  if (core::orientation(s[0], s[1], s[2], other) != core::Sign::zero) return false;
  const int axis = viewing_axis(s);
  return orientation(s[0], s[1], s[2], axis) == orientation(s[0], s[1], other, axis);
}

bool meet_beyond_shared(const TriMesh& mesh, Index i, Index j) {
  Triangle s = mesh.triangles[i], t = mesh.triangles[j];
  // Common corners first, in the same order.
  int shared = 0;
  for (int k = 0; k < 3; ++k) {
    const auto at = std::find(t.begin() + shared, t.end(), s[k]);
    if (at == t.end()) continue;
    std::swap(*at, t[shared]);
    std::swap(s[k], s[shared]);
    ++shared;
  }
  const auto corners = [&](const Triangle& n) {
    return Corners{mesh.vertices[n[0]], mesh.vertices[n[1]], mesh.vertices[n[2]]};
  };
  switch (shared) {
    case 0:
      return apart_triangles_meet(corners(s), corners(t));
    case 1:
      return fans_meet(corners(s), corners(t));
    case 2:
      return folded(corners(s), mesh.vertices[t[2]]);
    default:
      return true;
  }
}

struct Bounds {
  Vec3 low, high;
  Index triangle;

  bool overlaps(const Bounds& b) const noexcept {
    for (int k = 0; k < 3; ++k) {
      if (high[k] < b.low[k] || b.high[k] < low[k]) return false;
    }
    return true;
  }
};

}  // namespace

std::optional<std::pair<Index, Index>> first_self_intersection(const TriMesh& mesh) {
  std::vector<Bounds> bounds;
  bounds.reserve(mesh.triangles.size());
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (Index t = 0; t < mesh.triangles.size(); ++t) {
    const Vec3 a = mesh.corner(t, 0), b = mesh.corner(t, 1), c = mesh.corner(t, 2);
    bounds.push_back({a.cwiseMin(b).cwiseMin(c), a.cwiseMax(b).cwiseMax(c), t});
    low = low.cwiseMin(bounds.back().low);
    high = high.cwiseMax(bounds.back().high);
  }
  int axis = 0;
  (high - low).maxCoeff(&axis);
  std::sort(bounds.begin(), bounds.end(), [&](const Bounds& a, const Bounds& b) {
    return std::pair(a.low[axis], a.triangle) < std::pair(b.low[axis], b.triangle);
  });

  using Pair = std::pair<Index, Index>;
  constexpr Pair none = {no_index, no_index};
  std::vector<Pair> first_of(bounds.size(), none);
  constexpr std::size_t grain = 64;
  core::parallel_chunks(bounds.size(), grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Bounds& a = bounds[i];
      for (std::size_t j = i + 1; j < bounds.size() && bounds[j].low[axis] <= a.high[axis]; ++j) {
        if (!a.overlaps(bounds[j]) || !meet_beyond_shared(mesh, a.triangle, bounds[j].triangle)) continue;
        first_of[i] = std::min(first_of[i], Pair(std::minmax(a.triangle, bounds[j].triangle)));
      }
    }
  });
  const auto first = std::min_element(first_of.begin(), first_of.end());
  if (first == first_of.end() || *first == none) return std::nullopt;
  return *first;
}

}  // namespace condyle::sample
