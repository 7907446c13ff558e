#pragma once

#include <cstdint>
#include <vector>

#include "condyle/point_state.hpp"
#include "radial/exact/ray_scan.hpp"

namespace condyle {

/// The points that are not outside at one pose, one array per quantity, in the order of SortedPoints: points
/// that are neighbours in space follow each other.
struct Penetrations {
  /// Number of the point among those that SortedPoints was made from.
  std::vector<Index> point;
  /// Inside, or on the surface.
  std::vector<PointState> state;
  /// Winding number; for a point on the surface that of the side facing the centre.
  std::vector<int> winding;
  /// Triangle that the point leaves through by the nearer way; for a point on the surface one that it lies
  /// on.
  std::vector<Index> triangle;
  /// Along the ray to that triangle, mm; 0 on the surface.
  std::vector<double> depth;
  std::vector<radial::RayDirection> direction;
  /// Between the ray and the normal of that triangle, radians in [0, pi/2]. Filled by
  /// RadialTable::add_ray_to_normal, empty until then: an arctangent costs more than all else of a point.
  std::vector<double> ray_to_normal;

  std::size_t size() const noexcept { return point.size(); }
  void clear();
  /// All but ray_to_normal.
  void resize(std::size_t count);
  friend bool operator==(const Penetrations&, const Penetrations&) = default;
};

/// What one question cost; numbers add up over questions.
struct PenetrationWork {
  std::uint64_t blocks = 0,
                near_blocks = 0;  ///< of 16 points: all; those not rejected by the table's pyramid
  std::uint64_t near_points = 0;  ///< not rejected by the radii of their cell
  std::uint64_t triangles = 0;    ///< tried in float
  std::uint64_t doubtful = 0;     ///< points decided in double, or exactly
};

}  // namespace condyle
