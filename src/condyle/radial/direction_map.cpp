#include "condyle/radial/direction_map.hpp"

#include <array>
#include <limits>

namespace condyle {
namespace {

/// Widening of cells, in units of a cell map's coordinate (which spans [-1, 1]). It covers the rounding of
/// cell_of (a few units of 2^-53) and of clipping: a clipped corner errs by about 10 * 2^-53 of the
/// triangle's largest coordinate, and triangles nearer to the origin than `close_ratio` of that are not
/// clipped but listed everywhere, so that the error seen from the origin stays below 2e-10.
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
/// room beyond that is for corners that rounding splits when they lie on a cutting plane.
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
    error = 8 * 0x1p-53 * longest * longest;
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

struct Interval {
  double low, high;
};

Interval operator+(Interval a, Interval b) noexcept {
  return {a.low + b.low, a.high + b.high};
}
Interval operator*(double s, Interval a) noexcept {
  return s >= 0 ? Interval{s * a.low, s * a.high} : Interval{s * a.high, s * a.low};
}

/// The directions of a block of Cartesian cells.
struct DirectionBox {
  Interval x, y, z;

  /// Bounds of n . d over the box, for n known to within `error` in each component.
  Interval times(const Vec3& n, double error) const noexcept {
    const Interval value = n.x() * x + n.y() * y + n.z() * z;
    const double margin = cell_margin * n.cwiseAbs().sum() + 2 * error;
    return {value.low - margin, value.high + margin};
  }
};

double square(double s) noexcept {
  return s * s;
}

/// Smallest and largest s^2 over an interval.
Interval squared(Interval s) noexcept {
  const double low = s.low <= 0 && s.high >= 0 ? 0 : std::min(square(s.low), square(s.high));
  return {low, std::max(square(s.low), square(s.high))};
}

/// What the descent through blocks of Cartesian cells needs of one triangle.
struct ConeBounds {
  Vec3 edge[3];  // inward normals of the cone's sides, each component known to within edge_error
  double edge_error;
  Vec3 normal;  // of the triangle's plane, turned away from the origin
  double normal_error;
  Interval distance;  // of the origin from the plane, times |normal|
  Interval radius;

  explicit ConeBounds(const Cone& cone, double nearest)
      : edge{cone.a.cross(cone.b), cone.b.cross(cone.c), cone.c.cross(cone.a)},
        radius{nearest, max_radius(cone)} {
    const PlaneNormal plane(cone);
    edge_error = 4 * 0x1p-53 * radius.high * radius.high;
    normal = plane.n;
    normal_error = plane.error;
    double along = normal.dot(cone.a);
    if (along < 0) {
      for (auto& n : edge) n = -n;
      normal = -normal;
      along = -along;
    }
    const double slack = (cell_margin * normal.norm() + 2 * normal_error) * radius.high;
    distance = {along - slack, along + slack};
  }

  /// The radius interval over the box, or an empty one (low > high) where the cone does not meet it.
  ///
  /// In direction d the plane lies at radius distance / (normal . d). A cone seen edge-on has side normals
  /// whose turn is rounding: they then bound nothing, and the plane and the radii alone decide.
  Interval over(const DirectionBox& box) const noexcept {
    constexpr Interval empty{1, 0};
    const bool faces_origin = distance.low > 0;
    const Interval along = box.times(normal, normal_error);
    if (faces_origin) {
      if (along.high <= 0) return empty;
      for (const auto& n : edge) {
        if (box.times(n, edge_error).high < 0) return empty;
      }
    }
    // No direction of the box reaches the plane within the triangle's radii.
    if (std::max(along.high * radius.high, along.high * radius.low) < distance.low) return empty;
    if (along.low * radius.low > distance.high) return empty;
    Interval result = radius;
    if (faces_origin) result.low = std::max(result.low, distance.low / along.high * (1 - radius_margin));
    if (along.low > 0) result.high = std::min(result.high, distance.high / along.low * (1 + radius_margin));
    return result;
  }
};

}  // namespace

double min_radius(const Cone& cone) noexcept {
  return min_radius(polygon_of(cone), PlaneNormal(cone));
}

void CartesianMap::visit_cells(const Cone& cone, const std::function<void(const CellOverlap&)>& visit) const {
  const double nearest = min_radius(cone);
  if (is_close(cone, nearest)) return visit_all(cell_count(), max_radius(cone), visit);
  const ConeBounds bounds(cone, nearest);

  struct Block {
    int hemisphere, i0, i1, j0, j1;
  };
  const auto box_of = [this](const Block& block) {
    const double step = 2.0 / n_;
    const Interval x{block.i0 * step - 1, block.i1 * step - 1}, y{block.j0 * step - 1, block.j1 * step - 1};
    const Interval x2 = squared({x.low - cell_margin, x.high + cell_margin});
    const Interval y2 = squared({y.low - cell_margin, y.high + cell_margin});
    const Interval z{std::sqrt(std::max(0.0, 1 - x2.high - y2.high)),
                     std::sqrt(std::max(0.0, 1 - x2.low - y2.low))};
    return DirectionBox{x, y, block.hemisphere == 0 ? z : Interval{-z.high, -z.low}};
  };
  const auto outside_disc = [](const DirectionBox& box) {
    return squared(box.x).low + squared(box.y).low > 1 + 4 * cell_margin;
  };

  // A descent halves the longer side of one block and keeps the other half waiting: at most 2 log2(n) wait at
  // a time.
  std::array<Block, 72> waiting;
  std::size_t count = 0;
  waiting[count++] = {0, 0, n_, 0, n_};
  waiting[count++] = {1, 0, n_, 0, n_};
  while (count > 0) {
    const Block block = waiting[--count];
    const DirectionBox box = box_of(block);
    if (outside_disc(box)) continue;
    const Interval radius = bounds.over(box);
    if (radius.low > radius.high) continue;
    const int width = block.i1 - block.i0, height = block.j1 - block.j0;
    if (width == 1 && height == 1) {
      visit({static_cast<Index>(((block.hemisphere == 1 ? n_ : 0) + block.j0) * n_ + block.i0), radius.low,
             radius.high});
    } else if (width >= height) {
      const int middle = block.i0 + width / 2;
      waiting[count++] = {block.hemisphere, block.i0, middle, block.j0, block.j1};
      waiting[count++] = {block.hemisphere, middle, block.i1, block.j0, block.j1};
    } else {
      const int middle = block.j0 + height / 2;
      waiting[count++] = {block.hemisphere, block.i0, block.i1, block.j0, middle};
      waiting[count++] = {block.hemisphere, block.i0, block.i1, middle, block.j1};
    }
  }
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
      n[w] = sign * (cell_margin - direction * s);
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
      return std::pair{column(low - cell_margin), column(high + cell_margin)};
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

}  // namespace condyle
