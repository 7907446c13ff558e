#include "radial/exact/direction_map.hpp"

#include <array>
#include <limits>
#include <numbers>

#include "core/predicates.hpp"
#include "core/trigonometry.hpp"
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

struct Interval {
  double low, high;
};

/// Rounding of 1 - x^2 near the disc's rim, where its root, a coordinate of the direction, is most sensitive:
/// an error of 4u under the root is one of 2 sqrt(u) = 2.2e-8 beside it.
constexpr double rim_margin = 5e-8;

/// The directions of a block of Cartesian cells: x and y in two intervals, z >= 0 or z <= 0.
struct DirectionBox {
  Interval x, y;
  double hemisphere;  // +1 or -1

  bool holds(double px, double py) const noexcept {
    return px >= x.low && px <= x.high && py >= y.low && py <= y.high;
  }

  /// Whether no direction falls into the box: it lies outside the disc x^2 + y^2 <= 1.
  bool outside_disc() const noexcept {
    const auto nearest = [](Interval s) { return s.low > 0 ? s.low : s.high < 0 ? s.high : 0; };
    const double px = nearest(x), py = nearest(y);
    return px * px + py * py > 1 + 4 * cell_margin;
  }

  /// Largest n . d over the box, but for rim_margin. Where n itself lies in the box it is |n|; else the
  /// largest value is on the border: on a side, which is an arc of a circle, or on the rim z = 0.
  double largest(const Vec3& n) const noexcept {
    const double length = n.norm();
    const double up = hemisphere * n.z();
    if (up >= 0 && holds(n.x() / length, n.y() / length)) return length;
    double best = -length;
    // On the side s = fixed (s is x or y), t runs over an interval and z = sqrt(1 - s^2 - t^2).
    const auto side = [&](double n_s, double s, double n_t, Interval t) {
      const double radius = std::sqrt(std::max(0.0, 1 - s * s));
      const double low = std::max(t.low, -radius), high = std::min(t.high, radius);
      if (std::abs(s) > 1 + cell_margin || low > high) return;
      const auto at = [&](double p) {
        return n_s * s + n_t * p + up * std::sqrt(std::max(0.0, radius * radius - p * p));
      };
      best = std::max({best, at(low), at(high)});
      const double reach = core::hypotenuse(n_t, up);
      if (up > 0 && reach > 0) best = std::max(best, at(std::clamp(radius * n_t / reach, low, high)));
    };
    for (const double s : {x.low, x.high}) side(n.x(), s, n.y(), y);
    for (const double s : {y.low, y.high}) side(n.y(), s, n.x(), x);
    const double flat = core::hypotenuse(n.x(), n.y());
    if (flat > 0 && holds(n.x() / flat, n.y() / flat)) best = std::max(best, flat);
    return best;
  }

  /// Bounds of n . d over the box, for n known to within `error` in each component.
  Interval times(const Vec3& n, double error) const noexcept {
    const double margin = (cell_margin + rim_margin) * n.cwiseAbs().sum() + 2 * error;
    return {-largest(-n) - margin, largest(n) + margin};
  }
};

/// Bounds of one triangle for the descent through blocks of Cartesian cells.
struct ConeBounds {
  Vec3 edge[3];  // inward normals of the cone's sides, each component known to within edge_error
  double edge_error;
  Vec3 normal;  // of the triangle's plane, turned away from the origin
  double normal_error;
  Interval distance;  // of the origin from the plane, times |normal|
  Interval radius;
  Vec3 cap_axis;  // the cone lies within a cap: cap_axis . d >= cap_cosine, where that is positive
  double cap_cosine;

  explicit ConeBounds(const Cone& cone, double nearest)
      : edge{cone.a.cross(cone.b), cone.b.cross(cone.c), cone.c.cross(cone.a)},
        radius{nearest, max_radius(cone)} {
    const PlaneNormal plane(cone);
    edge_error = 4 * core::rounding_unit * radius.high * radius.high;
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
    const Vec3 a = cone.a.normalized(), b = cone.b.normalized(), c = cone.c.normalized();
    cap_axis = (a + b + c).normalized();
    cap_cosine = std::min({cap_axis.dot(a), cap_axis.dot(b), cap_axis.dot(c)}) - cell_margin;
  }

  /// Interval of coordinate k over the cap's directions.
  Interval coordinate(int k) const noexcept {
    if (cap_cosine <= 0) return {-1, 1};
    const double middle = core::arccosine(std::clamp(cap_axis[k], -1.0, 1.0));
    const double opening = core::arccosine(std::min(cap_cosine, 1.0));
    return {core::cosine(std::min(middle + opening, std::numbers::pi)) - rim_margin,
            core::cosine(std::max(middle - opening, 0.0)) + rim_margin};
  }

  /// The radius interval over the box, or an empty one (low > high) where the cone does not meet it.
  ///
  /// In direction d the plane lies at radius distance / (normal . d). A cone seen edge-on has side normals
  /// whose sense is rounding: they then bound nothing, and only the plane and the radii decide.
  Interval over(const DirectionBox& box) const noexcept {
    constexpr Interval empty{1, 0};
    // A cap holds the cone of three directions in it only where it is no more than a hemisphere. Without this
    // test, a cone seen edge-on would be put along its sides' whole great circle.
    if (cap_cosine > 0 && box.times(cap_axis, core::rounding_unit).high < cap_cosine) return empty;
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
    return DirectionBox{{block.i0 * step - 1 - cell_margin, block.i1 * step - 1 + cell_margin},
                        {block.j0 * step - 1 - cell_margin, block.j1 * step - 1 + cell_margin},
                        block.hemisphere == 0 ? 1.0 : -1.0};
  };

  // A descent halves the longer side of one block and keeps the other half waiting: at most 2 log2(n) wait at
  // a time.
  std::array<Block, 72> waiting;
  std::size_t count = 0;
  const Interval x = bounds.coordinate(0), y = bounds.coordinate(1), z = bounds.coordinate(2);
  const int i0 = column(x.low), i1 = column(x.high) + 1, j0 = column(y.low), j1 = column(y.high) + 1;
  if (z.high >= 0) waiting[count++] = {0, i0, i1, j0, j1};
  if (z.low <= 0) waiting[count++] = {1, i0, i1, j0, j1};
  while (count > 0) {
    const Block block = waiting[--count];
    const DirectionBox box = box_of(block);
    if (box.outside_disc()) continue;
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
