#pragma once

#include <optional>

#include "condyle/pose.hpp"
#include "motion/search/feature_tree.hpp"

namespace condyle::motion {

/// Two triangles of two bodies that some turn about the origin may bring together, and the smallest such
/// turn.
struct Clearance {
  double
      turn;  ///< rad: no rotation about the origin by less, about any axis, brings any two triangles together
  double distance_mm;
  Index fixed_triangle, mobile_triangle;  ///< places in the trees
  Vec3 fixed_point, mobile_point;         ///< nearest points, both in F
};

/// The smallest turn about the origin, about whatever axis, after which the bodies may touch; empty where it
/// is `enough` or more. Asked of bodies that do not touch.
///
/// A point at radius rho moves by at most rho times the angle, so triangles D apart need a turn of D / rho,
/// rho the largest radius of the mobile one; and a turn keeps every radius, so that triangles whose radii do
/// not overlap never meet at all: a head gliding in its socket needs no small steps. D is lowered by more
/// than all rounding on the way, for coordinates up to 10 m.
std::optional<Clearance> clearance(const FeatureTree& fixed, const FeatureTree& mobile, const Pose& X_FM,
                                   double enough);

}  // namespace condyle::motion
