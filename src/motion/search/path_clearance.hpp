#pragma once

#include <optional>

#include "condyle/pose.hpp"
#include "motion/search/feature_tree.hpp"

namespace condyle::motion {

/// How fast a body moves along some motion, at most, per unit of the motion's parameter.
struct Speed {
  double rotation = 1;   ///< rad, about whatever axis
  double origin_mm = 0;  ///< of its origin
};

/// Two triangles of two bodies that the motion may bring together, and the least of the motion that can.
struct Clearance {
  double free_for;     ///< less of the motion than this, either way, brings nothing together
  double distance_mm;  ///< between the two
  Index fixed_triangle, mobile_triangle;  ///< slots in tree order
  Vec3 fixed_point, mobile_point;         ///< nearest points, both in F
};

/// Clearances of a search along a path need not be known beyond this; a path this free takes a dozen steps per full turn.
inline constexpr double far_enough = 0.5;

/// Rounding of a step's length along a path, relative; steps are shortened by it.
inline constexpr double step_slack = 1e-12;

/// How much of a motion is free on either side of X_FM, whatever its path, the mobile body moving no faster than
/// `speed`; empty if it is `enough` or more. For bodies that do not meet at X_FM. By default the motion is a
/// rotation about M's origin, and its parameter the angle.
///
/// A point at radius rho from M's origin moves by at most rotation * rho + origin_mm per unit, so triangles D apart
/// are free for D / (rotation * rho + origin_mm), rho the largest radius of the mobile one. Every point keeps its
/// radius, and radii of fixed points change only as M's origin moves: triangles whose radii are G apart are free for
/// G / origin_mm, for ever where the origin rests: a head gliding in its socket needs no small steps. D and G are
/// lowered by more than all rounding on the way, for coordinates up to 10 m.
std::optional<Clearance> clearance(const FeatureTree& fixed, const FeatureTree& mobile, const Pose& X_FM,
                                   double enough, const Speed& speed = {});

}  // namespace condyle::motion
