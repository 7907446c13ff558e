#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "condyle/pose.hpp"
#include "core/ordered_sums.hpp"

/// The space below a triangle and what two such have in common, seen along z. docs/mathematics/03-both-directions.md.

namespace condyle::contact::prisms {

inline constexpr double unit_rounding = std::numeric_limits<double>::epsilon() / 2;

/// A point of a triangle seen along z.
struct Corner {
  double x, y, z;
};

inline Corner between(const Corner& a, const Corner& b, double t) noexcept {
  return {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y), a.z + t * (b.z - a.z)};
}

/// A convex polygon seen along z, counter-clockwise. Cutting it leaves at most one corner more.
struct Polygon {
  static constexpr std::size_t most = 20;
  std::array<Corner, most> corners;
  std::size_t count = 0;

  Polygon() noexcept {}  // the corners are nothing yet

  void push(const Corner& corner) noexcept {
    if (count < most) corners[count++] = corner;
  }
};

/// The part of the polygon in which value(corner number), linear over it, is at least 0.
template <class Value>
Polygon cut(const Polygon& polygon, const Value& value) noexcept {
  Polygon left;
  if (polygon.count == 0) return left;
  std::array<double, Polygon::most> values;
  bool all = true, any = false;
  double largest = 0;
  for (std::size_t k = 0; k < polygon.count; ++k) {
    values[k] = value(k);
    all &= values[k] >= 0, any |= values[k] >= 0;
    largest = std::max(largest, std::abs(values[k]));
  }
  if (all) return polygon;
  if (!any) return left;
  // A line crosses the border of a convex polygon twice. Where rounding shows more crossings, corners lie on the line.
  std::size_t crossings = 0;
  for (std::size_t k = 0; k < polygon.count; ++k)
    crossings += (values[k] >= 0) != (values[k + 1 < polygon.count ? k + 1 : 0] >= 0) ? 1 : 0;
  if (crossings > 2)
    for (std::size_t k = 0; k < polygon.count; ++k)
      if (std::abs(values[k]) <= 64 * unit_rounding * largest) values[k] = 0;
  for (std::size_t k = 0; k < polygon.count; ++k) {
    const std::size_t next = k + 1 < polygon.count ? k + 1 : 0;
    const bool here_left = values[k] >= 0, next_left = values[next] >= 0;
    if (here_left) left.push(polygon.corners[k]);
    if (here_left != next_left)
      left.push(between(polygon.corners[k], polygon.corners[next], values[k] / (values[k] - values[next])));
  }
  return left;
}

/// Area seen along z, and integral of z over it.
struct Moments {
  double area = 0, z = 0;
};

inline Moments moments_of(const Polygon& polygon) noexcept {
  Moments out;
  if (polygon.count < 3) return out;
  const Corner& o = polygon.corners[0];
  for (std::size_t k = 2; k < polygon.count; ++k) {
    const Corner &a = polygon.corners[k - 1], &b = polygon.corners[k];
    const double area = ((a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x)) / 2;
    out.area += area;
    out.z += area * (o.z + a.z + b.z) / 3;
  }
  return out;
}

/// Integral over the polygon of z, cut off below 0 and above `top`.
inline double integral_between(const Polygon& polygon, double top) noexcept {
  if (polygon.count < 3) return 0;
  double low = polygon.corners[0].z, high = low;
  for (std::size_t k = 1; k < polygon.count; ++k)
    low = std::min(low, polygon.corners[k].z), high = std::max(high, polygon.corners[k].z);
  if (high <= 0) return 0;
  const Polygon* above = &polygon;
  Polygon cut_above;
  if (low < 0) {
    cut_above = cut(polygon, [&](std::size_t k) { return polygon.corners[k].z; });
    above = &cut_above;
  }
  double integral = moments_of(*above).z;
  if (high > top) {
    const Moments beyond = moments_of(cut(*above, [&](std::size_t k) { return above->corners[k].z - top; }));
    integral -= beyond.z - top * beyond.area;
  }
  return integral;
}

/// The space below a triangle, seen along z, which is 0 at the bottom of the overlap's box.
class Prism {
 public:
  Index triangle;
  double sign;        ///< of its normal's z; the sum where it stands for several that coincide
  double twice_area;  ///< seen along z, above 0
  double secant;      ///< area over area seen along z
  double area;
  double steepness;               ///< longest edge seen, times height, over twice_area
  std::array<Corner, 3> corners;  ///< counter-clockwise seen from above
  double low_x, high_x, low_y, high_y, low_z, high_z;

  /// Nothing of a triangle that z runs along: nothing is below it.
  static std::optional<Prism> below(Index triangle, std::array<Corner, 3> corners) noexcept {
    const auto twice_area = [&] {
      return (corners[1].x - corners[0].x) * (corners[2].y - corners[0].y) -
             (corners[1].y - corners[0].y) * (corners[2].x - corners[0].x);
    };
    Prism prism;
    prism.triangle = triangle;
    prism.sign = 1;
    prism.twice_area = twice_area();
    if (prism.twice_area < 0) {
      std::swap(corners[1], corners[2]);
      prism.sign = -1, prism.twice_area = twice_area();
    }
    if (!(prism.twice_area > 0)) return std::nullopt;
    prism.corners = corners;
    const auto [a, b, c] = corners;
    const Vec3 normal = Vec3(b.x - a.x, b.y - a.y, b.z - a.z).cross(Vec3(c.x - a.x, c.y - a.y, c.z - a.z));
    prism.area = core::ordered_norm(normal) / 2;
    prism.secant = 2 * prism.area / prism.twice_area;
    prism.low_x = std::min({a.x, b.x, c.x}), prism.high_x = std::max({a.x, b.x, c.x});
    prism.low_y = std::min({a.y, b.y, c.y}), prism.high_y = std::max({a.y, b.y, c.y});
    prism.low_z = std::min({a.z, b.z, c.z}), prism.high_z = std::max({a.z, b.z, c.z});
    prism.steepness = (prism.high_x - prism.low_x + prism.high_y - prism.low_y) *
                      (prism.high_z - prism.low_z) / prism.twice_area;
    for (std::size_t k = 0; k < 3; ++k) prism.edges_[k] = Edge(corners[k], corners[(k + 1) % 3]);
    return prism;
  }

  std::array<double, 6> box() const noexcept { return {low_x, low_y, low_z, high_x, high_y, high_z}; }

  /// Whether the other triangle has these corners, whichever way round.
  bool coincides_with(const Prism& other) const noexcept {
    return std::all_of(corners.begin(), corners.end(), [&](const Corner& a) {
      return std::any_of(other.corners.begin(), other.corners.end(),
                         [&](const Corner& b) { return a.x == b.x && a.y == b.y && a.z == b.z; });
    });
  }

  bool may_share_a_column_with(const Prism& other) const noexcept {
    return low_x <= other.high_x && other.low_x <= high_x && low_y <= other.high_y && other.low_y <= high_y;
  }

  /// The part of a polygon over or under the triangle.
  Polygon clipped(const Polygon& polygon) const noexcept {
    // Most pairs have nothing in common, and most edges cut nothing.
    std::array<bool, 3> cuts;
    for (std::size_t e = 0; e < 3; ++e) {
      bool any_inside = false, any_outside = false;
      for (std::size_t k = 0; k < polygon.count; ++k) {
        const bool inside = edges_[e].side(polygon.corners[k]) >= 0;
        any_inside |= inside, any_outside |= !inside;
      }
      if (!any_inside) return Polygon();
      cuts[e] = any_outside;
    }
    Polygon part = polygon;
    for (std::size_t e = 0; e < 3 && part.count > 0; ++e)
      if (cuts[e]) part = cut(part, [&](std::size_t k) { return edges_[e].side(part.corners[k]); });
    return part;
  }

  /// The same, and adds what lies beyond each edge to `beyond`: together they are the polygon.
  Polygon divided(const Polygon& polygon, std::vector<Polygon>& beyond) const {
    Polygon part = polygon;
    for (const Edge& edge : edges_) {
      const Polygon outside = cut(part, [&](std::size_t k) { return -edge.side(part.corners[k]); });
      if (outside.count > 2) beyond.push_back(outside);
      part = cut(part, [&](std::size_t k) { return edge.side(part.corners[k]); });
    }
    return part;
  }

  /// Whether one of the triangle's edges has all of the other triangle beyond it.
  bool is_beside(const Prism& other) const noexcept {
    return std::any_of(edges_.begin(), edges_.end(), [&](const Edge& edge) {
      return std::all_of(other.corners.begin(), other.corners.end(),
                         [&](const Corner& corner) { return edge.side(corner) < 0; });
    });
  }

  /// Height of the triangle's plane: never beyond its corners, which a plane that z nearly runs along may be by far.
  double height_at(const Corner& p) const noexcept {
    const Corner& a = corners[0];
    const double dx = p.x - a.x, dy = p.y - a.y;
    const double ux = corners[1].x - a.x, uy = corners[1].y - a.y;
    const double vx = corners[2].x - a.x, vy = corners[2].y - a.y;
    const double of_u = dx * vy - dy * vx, of_v = ux * dy - uy * dx;
    const double z = a.z + (of_u * (corners[1].z - a.z) + of_v * (corners[2].z - a.z)) / twice_area;
    return std::clamp(z, low_z, high_z);
  }

 private:
  /// An edge from the smaller of its ends: of two triangles that share it each leaves exactly what the other takes.
  struct Edge {
    double x = 0, y = 0, along_x = 0, along_y = 0;

    Edge() = default;
    Edge(const Corner& from, const Corner& to) {
      const bool forth = from.x < to.x || (from.x == to.x && from.y < to.y);
      const Corner &o = forth ? from : to, &other = forth ? to : from;
      x = o.x, y = o.y;
      along_x = forth ? other.x - o.x : o.x - other.x;
      along_y = forth ? other.y - o.y : o.y - other.y;
    }
    double side(const Corner& p) const noexcept { return along_x * (p.y - y) - along_y * (p.x - x); }
  };
  std::array<Edge, 3> edges_;
};

}  // namespace condyle::contact::prisms
