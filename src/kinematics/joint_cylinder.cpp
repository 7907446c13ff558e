#include "kinematics/joint_cylinder.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "condyle/error.hpp"
#include "core/formatted.hpp"
#include "kinematics/hip_anatomy.hpp"
#include "kinematics/surface_points.hpp"

namespace condyle::kinematics {

JointCylinder joint_cylinder(const TriMesh& bone, const TriMesh& other, double reach_mm, double smallest,
                             double largest) {
  const auto facing = facing_part(bone, other);
  if (!facing) return {{}, "a bone has no surface"};
  if (facing->apart_mm > farthest_apart_mm)
    return {{}, core::formatted("the bones are %.0f mm apart", facing->apart_mm)};
  try {
    CylinderFit fit = find_cylinder_on(
        bone,
        {.smallest_radius = smallest, .largest_radius = largest, .within = Sphere{facing->centre, reach_mm}});
    if (*fit.direction_bound <= largest_axis_bound && *fit.axis_bound_mm <= largest_place_bound_mm)
      return {std::move(fit), {}};
    return {{},
            core::formatted("parts of the best cylinder, of radius %.1f mm, give axes up to %.1f degrees and "
                            "%.1f mm off (needs %.0f and %.0f)",
                            fit.cylinder.radius, fit.direction_bound->degrees(), *fit.axis_bound_mm,
                            largest_axis_bound.degrees(), largest_place_bound_mm)};
  } catch (const MeshError& error) {
    return {{}, error.what()};
  }
}

bool lies_across(const CylinderFit& fit, const Vec3& middle, const TriMesh& bone) {
  constexpr double most_along = 0.5;
  return std::abs((area_centroid(bone) - middle).normalized().dot(fit.cylinder.direction)) <= most_along;
}

Vec3 middle_of(const TriMesh& bone, const CylinderFit& fit) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Index v : fit.vertices) {
    const double height = (bone.vertices[v] - fit.cylinder.point).dot(fit.cylinder.direction);
    low = std::min(low, height), high = std::max(high, height);
  }
  return fit.cylinder.point + (low + high) / 2 * fit.cylinder.direction;
}

}  // namespace condyle::kinematics
