#pragma once

#include <string>

#include "condyle/fit.hpp"
#include "kinematics/facing_part.hpp"

namespace condyle::kinematics {

/// Bounds of a joint's axis that is said, and of a ball's centre.
inline constexpr Angle largest_axis_bound = Angle::degrees(3);
inline constexpr double largest_place_bound_mm = 2;
/// Bones of one joint are not farther apart than this.
inline constexpr double farthest_apart_mm = 30;

/// The cylinder of a bone where it faces another, and why there is none.
struct JointCylinder {
  std::optional<CylinderFit> fit;
  std::string why_none;
};

/// find_cylinder() in a ball around the facing part, if it fixes its axis within the bounds above. `smallest` and `largest` are
/// radii, mm.
JointCylinder joint_cylinder(const TriMesh& bone, const TriMesh& other, double reach_mm, double smallest,
                             double largest);

/// Whether the cylinder lies across the way from its middle to the centroid of a bone, to within 30 degrees: a joint's does,
/// and that of a shaft goes along it.
bool lies_across(const CylinderFit& fit, const Vec3& middle, const TriMesh& bone);

/// The middle of the length of a cylinder's surface, on its axis.
Vec3 middle_of(const TriMesh& bone, const CylinderFit& fit);

}  // namespace condyle::kinematics
