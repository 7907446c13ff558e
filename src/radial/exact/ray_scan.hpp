#pragma once

#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "condyle/radial.hpp"
#include "core/predicates.hpp"
#include "radial/exact/direction_map.hpp"
#include "radial/exact/ray_crossing.hpp"

namespace condyle::radial {

inline Cone cone_of(const TriMesh& mesh, Index triangle) {
  return {mesh.corner(triangle, 0), mesh.corner(triangle, 1), mesh.corner(triangle, 2)};
}

/// Signed distance in mm from v along its ray, outwards positive, to the plane of a triangle the ray crosses;
/// within 1e-12 of |v|, whatever the angle at which the ray meets the surface.
double distance_along_ray(const Vec3& v, const Cone& t);

/// Between the ray through v and the triangle's normal, 0 to a right angle.
Angle angle_to_normal(const Vec3& v, const Cone& t) noexcept;

/// Result of the ray from the centre through one point: one element of RadialResults.
struct RayAnswer {
  PointState state;
  int winding;
  double gap;
  Index triangle;
  RayDirection direction;
};

/// The plain way to answer for one point at a time, exact: what every faster way is held against.
///
/// Crossings of the point's ray with the triangles that it is given are gathered in the scan's own scratch.
class RayScan {
 public:
  RayScan(const TriMesh& mesh, int winding_at_centre);

  /// All triangles that the ray through v can meet are to be among those given, each once.
  RayAnswer answer(const Vec3& v, std::span<const Index> triangles);
  /// The same with the results of ray_crossing() and distance_along_ray() for a triangle, given by callers who know
  /// them sooner.
  template <class CrossingOf, class DistanceTo>
  RayAnswer answer(const Vec3& v, std::span<const Index> triangles, const CrossingOf& crossing_of,
                   const DistanceTo& distance_to);

 private:
  struct Crossing {
    double
        fraction;  // of the way from the centre to the point, where some are to be ordered; no good for depths
    core::Sign outwards;
    bool before_point;
    Index triangle;

    /// Before or after the point is exact; between two crossings on one side of it, double decides.
    friend bool operator<(const Crossing& a, const Crossing& b) noexcept {
      if (a.before_point != b.before_point) return a.before_point;
      if (a.fraction != b.fraction) return a.fraction < b.fraction;
      return a.triangle < b.triangle;
    }
  };
  /// Where the solid's boundary is crossed on each side of the point, overlapping solids counted by winding
  /// number: the last change between w <= 0 and w > 0 before the point and the first after it. no_index if there
  /// is none.
  struct Neighbours {
    Index before = no_index, after = no_index;
  };

  void add(const RayCrossing& crossing, Index triangle);
  /// Winding number of the point (of its side towards the centre, where it is on the surface).
  int winding() const noexcept;
  PointState collected_state() const noexcept;
  void sort_crossings(const Vec3& v);
  Neighbours boundary_crossings(const Vec3& v);

  const TriMesh& mesh_;
  int winding_at_centre_;
  std::vector<Crossing> crossings_;
  Index on_triangle_ = no_index;
};

template <class CrossingOf, class DistanceTo>
RayAnswer RayScan::answer(const Vec3& v, std::span<const Index> triangles, const CrossingOf& crossing_of,
                          const DistanceTo& distance_to) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const bool from_inside = winding_at_centre_ > 0;
  RayAnswer answer{PointState::outside, winding_at_centre_, infinity, no_index,
                   from_inside ? RayDirection::towards_centre : RayDirection::away_from_centre};
  if (v == Vec3::Zero()) {
    if (from_inside) answer.state = PointState::inside, answer.gap = -infinity;
    return answer;
  }
  crossings_.clear();
  on_triangle_ = no_index;
  for (const Index t : triangles) add(crossing_of(t), t);
  answer.winding = winding();
  answer.state = collected_state();
  if (answer.state == PointState::on_surface) {
    answer.triangle = on_triangle_;
    answer.gap = 0;
    return answer;
  }
  const auto [before, after] = boundary_crossings(v);
  const auto distance = [&](Index t) { return t == no_index ? infinity : std::abs(distance_to(t)); };
  const bool inside = answer.state == PointState::inside;
  const double inwards = inside || from_inside ? distance(before) : infinity;
  const double outwards = inside || !from_inside ? distance(after) : infinity;
  const bool towards = inside ? inwards <= outwards : from_inside;
  answer.triangle = towards ? before : after;
  answer.direction = towards ? RayDirection::towards_centre : RayDirection::away_from_centre;
  const double length = towards ? inwards : outwards;
  answer.gap = inside ? -length : length;
  return answer;
}

}  // namespace condyle::radial
