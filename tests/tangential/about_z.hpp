#pragma once

#include "condyle/tangential.hpp"
#include "core/predicates.hpp"
#include "support/test.hpp"
#include "tangential/build/profile_grid.hpp"

/// Points that rotate about the z axis, and how well their angles are known.

namespace condyle::test {

inline constexpr double infinity = std::numeric_limits<double>::infinity();

inline const AxisFrame z_axis(Vec3::Zero(), Vec3::UnitZ());

inline tangential::TangentialResults query_one(
    const TriMesh& mesh, const Vec3& p,
    tangential::TangentialRule rule = tangential::TangentialRule::alternating) {
  Points points;
  points.push_back(p);
  return tangential::RingTable(mesh, z_axis).query(points, rule);
}

inline Vec3 on_circle(double rho, double degrees, double z) {
  const double angle = Angle::degrees(degrees).radians();
  return {rho * std::cos(angle), rho * std::sin(angle), z};
}

/// Bound for the angle of a crossing of meshes within `scale` of the axis, not touching: ends off by 17u
/// scale, a point given with 2u of its radius, crossing at no less than 30 degrees.
inline double angle_error(double scale, double rho) {
  return 2 * 19 * core::rounding_unit * scale / rho + 8 * core::rounding_unit;
}

}  // namespace condyle::test
