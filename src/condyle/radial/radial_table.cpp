#include "condyle/radial/radial_table.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "condyle/core/error.hpp"
#include "condyle/core/exact_integers.hpp"
#include "condyle/core/parallel.hpp"
#include "condyle/mesh/edge_balance.hpp"
#include "condyle/radial/ray_crossing.hpp"

namespace condyle {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Points per task: enough to outweigh starting one.
constexpr std::size_t points_per_chunk = 256;

std::variant<CartesianMap, CubeMap> make_map(const RadialOptions& options) {
  // 2048^2 cells a face is 25 million cells: past that the table outgrows any mesh it could serve.
  if (options.cells_per_side < 1 || options.cells_per_side > 2048) {
    throw UsageError("cells_per_side is " + std::to_string(options.cells_per_side) +
                     ", not within 1 to 2048");
  }
  if (options.map == DirectionMapKind::cartesian) return CartesianMap(options.cells_per_side);
  return CubeMap(options.cells_per_side);
}

Cone cone_of(const TriMesh& mesh, Index triangle) {
  return {mesh.corner(triangle, 0), mesh.corner(triangle, 1), mesh.corner(triangle, 2)};
}

/// A crossing on the ray of one point, with where it lies along the ray.
struct CrossingAt {
  double fraction;  // of the way from the centre to the point; good for ordering, not for depths
  Sign outwards;
  bool before_point;
  Index triangle;

  /// Before or after the point is exact; between two crossings on one side of it, double decides.
  friend bool operator<(const CrossingAt& a, const CrossingAt& b) noexcept {
    if (a.before_point != b.before_point) return a.before_point;
    if (a.fraction != b.fraction) return a.fraction < b.fraction;
    return a.triangle < b.triangle;
  }
};

double fraction_along_ray(const Vec3& v, const Cone& t) noexcept {
  const double past = filtered_determinant(v - t.a, t.b - t.a, t.c - t.a).value;  // v . N - D
  const double full = filtered_determinant(v, t.b - t.a, t.c - t.a).value;        // v . N
  return full != 0 ? 1 - past / full : 1;
}

/// (D - v . N) / (v . N): the signed way from v to the triangle's plane along the ray, in units of |v|.
double exact_relative_gap(const Vec3& v, const Cone& t) {
  const auto n = exact::to_integers<12>(
      {v.x(), v.y(), v.z(), t.a.x(), t.a.y(), t.a.z(), t.b.x(), t.b.y(), t.b.z(), t.c.x(), t.c.y(), t.c.z()});
  std::array<exact::Integer, 3> ab, ac, normal;
  for (std::size_t k = 0; k < 3; ++k) ab[k] = n[6 + k] - n[3 + k], ac[k] = n[9 + k] - n[3 + k];
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
    normal[k] = ab[i] * ac[j] - ab[j] * ac[i];
  }
  exact::Integer to_plane = 0, full = 0;
  for (std::size_t k = 0; k < 3; ++k) to_plane += (n[3 + k] - n[k]) * normal[k], full += n[k] * normal[k];
  return exact::quotient(to_plane, full);
}

/// Signed distance in mm from v along its ray, outwards positive, to the plane of a triangle the ray crosses.
///
/// Both determinants err by at most 12u times a product of lengths: 8u for their own operations, and u for
/// each of the rounded differences in them. Where that could show in the quotient (a ray within a degree or
/// so of the surface, a sliver), the quotient is taken in integers.
double distance_along_ray(const Vec3& v, const Cone& t) {
  const Vec3 ab = t.b - t.a, ac = t.c - t.a, av = v - t.a;
  const double past = filtered_determinant(av, ab, ac).value, full = filtered_determinant(v, ab, ac).value;
  const double radius = v.norm();
  const double error = 12 * rounding_unit * ab.norm() * ac.norm() * (radius + av.norm());
  constexpr double accepted = 3e-13;
  const double relative = error <= accepted * std::abs(full) ? -past / full : exact_relative_gap(v, t);
  return relative * radius;
}

double angle_to_normal(const Vec3& v, const Cone& t) noexcept {
  const Vec3 normal = (t.b - t.a).cross(t.c - t.a);
  return std::atan2(v.cross(normal).norm(), std::abs(v.dot(normal)));
}

/// Crossings of one point's ray, in the room of its chunk.
class RayScan {
 public:
  RayScan(const TriMesh& mesh, int winding_at_centre) : mesh_(mesh), winding_at_centre_(winding_at_centre) {
    crossings_.reserve(64);
  }

  void collect(const Vec3& v, std::span<const Index> triangles) {
    crossings_.clear();
    on_triangle_ = no_index;
    for (const Index t : triangles) {
      const Cone cone = cone_of(mesh_, t);
      const RayCrossing crossing = ray_crossing(v, cone.a, cone.b, cone.c);
      if (crossing.point_on_triangle) on_triangle_ = std::min(on_triangle_, t);
      if (crossing.outwards == Sign::zero) continue;
      crossings_.push_back({fraction_along_ray(v, cone), crossing.outwards, crossing.before_point, t});
    }
  }

  /// Winding number of the point (of its side towards the centre, where it is on the surface).
  int winding() const noexcept {
    int w = winding_at_centre_;
    for (const auto& crossing : crossings_) {
      if (crossing.before_point) w -= static_cast<int>(crossing.outwards);
    }
    return w;
  }

  Index on_triangle() const noexcept { return on_triangle_; }
  std::span<const CrossingAt> crossings() const noexcept { return crossings_; }

  PointState state() const noexcept {
    return on_triangle_ != no_index ? PointState::on_surface
           : winding() > 0          ? PointState::inside
                                    : PointState::outside;
  }

  /// Where the solid's skin is crossed on each side of the point, counting several skins by winding number:
  /// the last change between w <= 0 and w > 0 before the point and the first after it. no_index where there
  /// is none.
  struct Neighbours {
    Index before = no_index, after = no_index;
  };
  Neighbours skins() {
    std::sort(crossings_.begin(), crossings_.end());
    Neighbours skins;
    int w = winding_at_centre_;
    for (const auto& crossing : crossings_) {
      const bool was_inside = w > 0;
      w -= static_cast<int>(crossing.outwards);
      if (was_inside == (w > 0)) continue;
      if (crossing.before_point) {
        skins.before = crossing.triangle;
      } else if (skins.after == no_index) {
        skins.after = crossing.triangle;
      }
    }
    return skins;
  }

 private:
  const TriMesh& mesh_;
  int winding_at_centre_;
  std::vector<CrossingAt> crossings_;
  Index on_triangle_ = no_index;
};

}  // namespace

void RadialHits::resize(std::size_t count) {
  state.resize(count), winding.resize(count), radial_gap.resize(count);
  triangle.resize(count), direction.resize(count), ray_to_normal.resize(count);
}

RadialTable::RadialTable(TriMesh mesh, RadialOptions options)
    : mesh_(std::move(mesh)), map_(make_map(options)) {
  for (Index t = 0; t < mesh_.triangles.size(); ++t) {
    const Cone cone = cone_of(mesh_, t);
    if (orientation(cone.a, cone.b, cone.c) == Sign::zero &&
        contains_coplanar({cone.a, cone.b, cone.c}, Vec3::Zero())) {
      throw MeshError("the joint centre lies on the surface, in triangle " + std::to_string(t));
    }
  }
  fill();
  boundary_edge_ = unbalanced_edge(mesh_);
  if (boundary_edge_) return;
  // Far out the winding number is zero; every skin crossed on the way in adds what it is wound.
  const Vec3 any_direction(0, 0, 1);
  const Index cell = cell_of(any_direction);
  int winding = 0;
  for (std::uint32_t i = offset_[cell]; i < offset_[cell + 1]; ++i) {
    const Cone cone = cone_of(mesh_, triangle_[i]);
    winding += static_cast<int>(ray_crossing(any_direction, cone.a, cone.b, cone.c).outwards);
  }
  winding_at_centre_ = winding;
}

void RadialTable::fill() {
  struct Entry {
    Index cell, triangle;
  };
  const Index cells = std::visit([](const auto& map) { return map.cell_count(); }, map_);
  offset_.assign(cells + 1, 0);
  bounds_.assign(cells, {infinity, 0});
  std::vector<Entry> entries;
  entries.reserve(4 * mesh_.triangles.size());
  for (Index t = 0; t < mesh_.triangles.size(); ++t) {
    const auto add = [&](const CellOverlap& overlap) {
      entries.push_back({overlap.cell, t});
      ++offset_[overlap.cell + 1];
      auto& bounds = bounds_[overlap.cell];
      bounds.min_squared_radius =
          std::min(bounds.min_squared_radius, overlap.min_radius * overlap.min_radius);
      bounds.max_squared_radius =
          std::max(bounds.max_squared_radius, overlap.max_radius * overlap.max_radius);
    };
    std::visit([&](const auto& map) { map.visit_cells(cone_of(mesh_, t), add); }, map_);
  }
  for (Index cell = 0; cell < cells; ++cell) offset_[cell + 1] += offset_[cell];
  triangle_.resize(entries.size());
  std::vector<std::uint32_t> next(offset_.begin(), offset_.end() - 1);
  for (const auto& [cell, triangle] : entries) triangle_[next[cell]++] = triangle;
}

void RadialTable::require_closed() const {
  if (boundary_edge_) refuse_unbalanced(*boundary_edge_);
}

void RadialTable::query(PointsView points, RadialHits& out) const {
  require_closed();
  out.resize(points.size());
  const int at_centre = *winding_at_centre_;
  parallel_chunks(points.size(), points_per_chunk, [&](std::size_t first, std::size_t last) {
    RayScan scan(mesh_, at_centre);
    for (std::size_t i = first; i < last; ++i) {
      const Vec3 v = points[i];
      out.triangle[i] = no_index;
      out.direction[i] = at_centre > 0 ? RayDirection::towards_centre : RayDirection::away_from_centre;
      out.ray_to_normal[i] = 0;
      if (v == Vec3::Zero()) {
        out.winding[i] = at_centre;
        out.state[i] = at_centre > 0 ? PointState::inside : PointState::outside;
        out.radial_gap[i] = at_centre > 0 ? -infinity : infinity;
        continue;
      }
      const Index cell = cell_of(v);
      scan.collect(v, std::span(triangle_).subspan(offset_[cell], offset_[cell + 1] - offset_[cell]));
      out.winding[i] = scan.winding();
      out.state[i] = scan.state();
      if (out.state[i] == PointState::on_surface) {
        out.triangle[i] = scan.on_triangle();
        out.radial_gap[i] = 0;
      } else {
        const auto [before, after] = scan.skins();
        const auto distance = [&](Index t) {
          return t == no_index ? infinity : std::abs(distance_along_ray(v, cone_of(mesh_, t)));
        };
        const bool inside = out.state[i] == PointState::inside;
        const double inwards = inside || at_centre > 0 ? distance(before) : infinity;
        const double outwards = inside || at_centre <= 0 ? distance(after) : infinity;
        const bool towards = inside ? inwards <= outwards : at_centre > 0;
        out.triangle[i] = towards ? before : after;
        out.direction[i] = towards ? RayDirection::towards_centre : RayDirection::away_from_centre;
        const double length = towards ? inwards : outwards;
        out.radial_gap[i] = inside ? -length : length;
      }
      if (out.triangle[i] != no_index)
        out.ray_to_normal[i] = angle_to_normal(v, cone_of(mesh_, out.triangle[i]));
    }
  });
}

RadialHits RadialTable::query(PointsView points) const {
  RadialHits out;
  query(points, out);
  return out;
}

void RadialTable::query_states(PointsView points, std::vector<PointState>& out) const {
  require_closed();
  out.resize(points.size());
  const int at_centre = *winding_at_centre_;
  parallel_chunks(points.size(), points_per_chunk, [&](std::size_t first, std::size_t last) {
    RayScan scan(mesh_, at_centre);
    for (std::size_t i = first; i < last; ++i) {
      const Vec3 v = points[i];
      const PointState state_at_centre = at_centre > 0 ? PointState::inside : PointState::outside;
      if (v == Vec3::Zero()) {
        out[i] = state_at_centre;
        continue;
      }
      const Index cell = cell_of(v);
      const double squared_radius = v.squaredNorm();
      if (squared_radius < bounds_[cell].min_squared_radius) {
        out[i] = state_at_centre;
      } else if (squared_radius > bounds_[cell].max_squared_radius) {
        out[i] = PointState::outside;
      } else {
        scan.collect(v, std::span(triangle_).subspan(offset_[cell], offset_[cell + 1] - offset_[cell]));
        out[i] = scan.state();
      }
    }
  });
}

RadialTableSize RadialTable::table_size() const noexcept {
  Index longest = 0;
  for (std::size_t cell = 0; cell + 1 < offset_.size(); ++cell) {
    longest = std::max(longest, offset_[cell + 1] - offset_[cell]);
  }
  return {bounds_.size(), triangle_.size(),
          offset_.size() * sizeof(offset_[0]) + triangle_.size() * sizeof(Index) +
              bounds_.size() * sizeof(CellBounds),
          longest};
}

}  // namespace condyle
