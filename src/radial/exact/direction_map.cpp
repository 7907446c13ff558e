#include "radial/exact/direction_map.hpp"

#include <array>
#include <limits>

#include "core/predicates.hpp"
#include "radial/exact/cell_dop.hpp"

namespace condyle::radial {
namespace {

/// Widening of cells, in units of a cell map's coordinate (which spans [-1, 1]). It covers the rounding of
/// cell_of (a few units of 2^-53) and of clipping: a clipped corner errs by about 10 * 2^-53 of the
/// triangle's largest coordinate, and triangles nearer to the origin than `close_ratio` of that are not
/// clipped but put everywhere, so that the error seen from the origin stays below 2e-10.
constexpr double cell_margin = 1e-9;
constexpr double close_ratio = 1e-5;

/// Widening of radii, relative: the rounding of squares, sums and roots, and of the margin above.
constexpr double radius_margin = 1e-8;

double largest_coordinate(const Cone& cone) noexcept {
  return std::max({cone.a.cwiseAbs().maxCoeff(), cone.b.cwiseAbs().maxCoeff(), cone.c.cwiseAbs().maxCoeff()});
}

double squared_distance_to_segment(const Vec3& p, const Vec3& q) noexcept {
  const Vec3 along = q - p;
  const double length2 = along.squaredNorm();
  const double t = length2 > 0 ? std::clamp(-p.dot(along) / length2, 0.0, 1.0) : 0.0;
  return (p + t * along).squaredNorm();
}

/// A convex plane polygon in space: a triangle cut by at most eight planes has at most eleven corners. The
/// capacity beyond that is for corners that rounding splits when they lie on a cutting plane.
struct Polygon {
  std::array<Vec3, 32> corner;
  int size = 0;

  void add(const Vec3& p) noexcept {
    assert(size < static_cast<int>(corner.size()));
    corner[static_cast<std::size_t>(size++)] = p;
  }
  const Vec3& operator[](int i) const noexcept { return corner[static_cast<std::size_t>(i)]; }
};

/// The part of the polygon where normal . p >= 0.
Polygon clipped(const Polygon& in, const Vec3& normal) noexcept {
  Polygon out;
  for (int i = 0; i < in.size; ++i) {
    const Vec3 &p = in[i], &q = in[i + 1 < in.size ? i + 1 : 0];
    const double at_p = normal.dot(p), at_q = normal.dot(q);
    if (at_p >= 0) out.add(p);
    if ((at_p >= 0) != (at_q >= 0)) out.add(p + (at_p / (at_p - at_q)) * (q - p));
  }
  return out;
}

/// The plane of a triangle: normal of any length with the rounding error of each component, and
/// `sliver_width`, zero but for triangles so thin that their normal's direction is rounding: those count as
/// their edges, widened.
struct PlaneNormal {
  Vec3 n;
  double error;
  double sliver_width = 0;

  explicit PlaneNormal(const Cone& cone) : n((cone.b - cone.a).cross(cone.c - cone.a)) {
    const double longest =
        std::max({(cone.b - cone.a).norm(), (cone.c - cone.b).norm(), (cone.a - cone.c).norm()});
    error = 8 * core::rounding_unit * longest * longest;
    if (n.norm() < 1e6 * error) sliver_width = (n.norm() + 2 * error) / longest;
  }
};

/// Bound on the distance from the origin to a convex polygon in the given plane, never above the true one by
/// more than radius_margin.
double min_radius(const Polygon& polygon, const PlaneNormal& plane) noexcept {
  const Vec3& normal = plane.n;
  double nearest = std::numeric_limits<double>::infinity();
  bool foot_inside = true;
  for (int i = 0; i < polygon.size; ++i) {
    const Vec3 &p = polygon[i], &q = polygon[i + 1 < polygon.size ? i + 1 : 0];
    nearest = std::min(nearest, squared_distance_to_segment(p, q));
    // The triangle (foot of the perpendicular, p, q) turns as the polygon does where the foot is on the inner
    // side.
    foot_inside &= p.cross(q).dot(normal) >= -cell_margin * p.norm() * q.norm() * normal.norm();
  }
  const double length2 = normal.squaredNorm();
  if (foot_inside && length2 > 0) {
    const double distance = normal.dot(polygon[0]);
    nearest = std::min(nearest, distance * distance / length2);
  }
  return std::max(0.0, std::sqrt(nearest) * (1 - radius_margin) - plane.sliver_width);
}

CellOverlap overlap(Index cell, const Polygon& polygon, const PlaneNormal& plane) noexcept {
  double furthest = 0;
  for (int i = 0; i < polygon.size; ++i) furthest = std::max(furthest, polygon[i].squaredNorm());
  return {cell, min_radius(polygon, plane), std::sqrt(furthest) * (1 + radius_margin)};
}

Polygon polygon_of(const Cone& cone) noexcept {
  Polygon polygon;
  polygon.add(cone.a), polygon.add(cone.b), polygon.add(cone.c);
  return polygon;
}

double max_radius(const Cone& cone) noexcept {
  return std::sqrt(std::max({cone.a.squaredNorm(), cone.b.squaredNorm(), cone.c.squaredNorm()})) *
         (1 + radius_margin);
}

/// Whether the triangle comes so near to the origin that its cone cannot be clipped to the stated margin.
bool is_close(const Cone& cone, double distance) noexcept {
  return distance <= close_ratio * largest_coordinate(cone);
}

void visit_all(Index cell_count, double furthest, const std::function<void(const CellOverlap&)>& visit) {
  for (Index cell = 0; cell < cell_count; ++cell) visit({cell, 0, furthest});
}

}  // namespace

double min_radius(const Cone& cone) noexcept {
  return min_radius(polygon_of(cone), PlaneNormal(cone));
}

CartesianBox CartesianMap::box_of(const Vec3& a, const Vec3& b, const Vec3& c) const noexcept {
  const auto side = static_cast<std::int16_t>(n_);
  const double longest_squared =
      std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
  if (!(longest_squared < 3 - cell_margin)) return {0, side, 0, side, true, true};
  const double bulge = 1 - std::sqrt(1 - longest_squared / 3) + cell_margin;
  const Vec3 low = a.cwiseMin(b).cwiseMin(c), high = a.cwiseMax(b).cwiseMax(c);
  const auto first = [&](int k) { return static_cast<std::int16_t>(column(low[k] - bulge)); };
  const auto end = [&](int k) { return static_cast<std::int16_t>(column(high[k] + bulge) + 1); };
  return {first(0), end(0), first(1), end(1), high.z() >= -cell_margin, low.z() <= cell_margin};
}

CellPlace CubeMap::place_of(const Vec3& v) const noexcept {
  const double x = std::abs(v.x()), y = std::abs(v.y()), z = std::abs(v.z());
  const int axis = x >= y && x >= z ? 0 : y >= z ? 1 : 2;
  constexpr std::array<int, 5> cyclic = {0, 1, 2, 0, 1};
  const auto k = static_cast<std::size_t>(axis);
  const double largest = std::abs(v[axis]);
  struct Place {
    int cell, part;
  };
  const auto along = [&](int other) {
    const double at = (v[other] / largest + 1) * (0.5 * n_);
    const int cell = std::clamp(static_cast<int>(at), 0, n_ - 1);
    return Place{cell, std::clamp(static_cast<int>((at - cell) * parts_per_cell), 0, parts_per_cell - 1)};
  };
  const Place column = along(cyclic[k + 1]), row = along(cyclic[k + 2]);
  const int face = v[axis] < 0 ? axis + 3 : axis;
  return {static_cast<Index>((face * n_ + row.cell) * n_ + column.cell),
          packed_range(column.part, column.part, row.part, row.part)};
}

void CubeMap::visit_cells(const Cone& cone, const std::function<void(const CellOverlap&)>& visit) const {
  if (is_close(cone, min_radius(cone))) return visit_all(cell_count(), max_radius(cone), visit);
  const PlaneNormal plane(cone);
  const double step = 2.0 / n_;
  for (int face = 0; face < 6; ++face) {
    const int w = face % 3, u = (w + 1) % 3, v = (w + 2) % 3;
    const double sign = face < 3 ? 1 : -1;
    // The plane through the origin on which p[k] = s |p[w]|, facing smaller (direction -1) or larger (+1)
    // p[k].
    const auto side = [&](int k, double s, double direction) {
      Vec3 n = Vec3::Zero();
      n[k] = direction;
      n[w] = sign * (list_margin - direction * s);
      return n;
    };
    const auto range = [&](const Polygon& polygon, int k) {
      double low = 1, high = -1;
      for (int i = 0; i < polygon.size; ++i) {
        // A corner on the far side is the rounding of one at the origin's plane: it bounds nothing.
        const double depth = sign * polygon[i][w];
        const double s = depth > 0           ? std::clamp(polygon[i][k] / depth, -1.0, 1.0)
                         : polygon[i][k] > 0 ? 1.0
                                             : -1.0;
        low = std::min(low, s), high = std::max(high, s);
      }
      return std::pair{column(low - list_margin), column(high + list_margin)};
    };

    Polygon on_face = polygon_of(cone);
    for (const Vec3& n : {side(u, -1, 1), side(u, 1, -1), side(v, -1, 1), side(v, 1, -1)}) {
      if (on_face.size > 0) on_face = clipped(on_face, n);
    }
    if (on_face.size == 0) continue;

    const auto [first_row, last_row] = range(on_face, v);
    for (int row = first_row; row <= last_row; ++row) {
      const double low = row * step - 1;
      const Polygon in_row = clipped(clipped(on_face, side(v, low, 1)), side(v, low + step, -1));
      if (in_row.size == 0) continue;
      const auto [first_column, last_column] = range(in_row, u);
      for (int col = first_column; col <= last_column; ++col) {
        const double left = col * step - 1;
        const Polygon in_cell = clipped(clipped(in_row, side(u, left, 1)), side(u, left + step, -1));
        if (in_cell.size > 0)
          visit(overlap(static_cast<Index>((face * n_ + row) * n_ + col), in_cell, plane));
      }
    }
  }
}

}  // namespace condyle::radial
