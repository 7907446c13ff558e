#pragma once

#include <optional>

#include "condyle/pose.hpp"
#include "motion/search/feature_tree.hpp"

namespace condyle::motion {

/// Two triangles of two bodies that some rotation about the origin may bring together, and the smallest such
/// rotation.
struct Clearance {
  double rotation;  ///< rad: none by less, about any axis through the origin, brings two triangles together
  double distance_mm;                     ///< between the two
  Index fixed_triangle, mobile_triangle;  ///< slots in tree order
  Vec3 fixed_point, mobile_point;         ///< nearest points, both in F
};

/// The smallest rotation about the origin, about whatever axis, after which the bodies may meet; empty where
/// it is `enough` or more. For bodies that do not meet at X_FM.
///
/// A point at radius rho moves by at most rho times the angle, so triangles D apart need a rotation of D / rho,
/// rho the largest radius of the mobile one; and it keeps every radius, so that triangles whose radii do
/// not overlap never meet at all: a head gliding in its socket needs no small steps. D is lowered by more
/// than all rounding on the way, for coordinates up to 10 m.
std::optional<Clearance> clearance(const FeatureTree& fixed, const FeatureTree& mobile, const Pose& X_FM,
                                   double enough);

}  // namespace condyle::motion
