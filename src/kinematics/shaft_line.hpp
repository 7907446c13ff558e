#pragma once

#include <optional>

#include "condyle/fit.hpp"

namespace condyle::kinematics {

/// The line along which a long bone goes on from its joint: through the centroids of slices across it.
struct ShaftLine {
  Vec3 point, direction;     ///< mm; unit, away from the joint
  double first_mm, last_mm;  ///< the part that was used, along the line from the joint
  double reach_mm;           ///< to the end of the bone
  double bound_deg;  ///< of the direction: two standard errors, from how the centroids stray from the line
};

/// The smallest length, and the largest bound, of a shaft whose direction is reported.
inline constexpr double shortest_shaft_mm = 25, largest_shaft_bound_deg = 8;

/// From the joint centre roughly towards `direction`, of slices that begin at a distance from it (beyond the flare of condyles)
/// and end before the bone does, and before `most_mm`. Empty if the bone does not go on so far, or its slices leave the line open.
/// Linear in the bone.
std::optional<ShaftLine> shaft_line(const TriMesh& bone, const Vec3& joint, const Vec3& direction,
                                    double begins_mm, double most_mm);

}  // namespace condyle::kinematics
