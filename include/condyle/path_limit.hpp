#pragma once

#include <memory>
#include <span>
#include <vector>

#include "condyle/range_of_motion.hpp"

/// How far a joint follows a path on which several angles change at once.

namespace condyle {

/// Where a path ends.
struct PathLimit {
  std::size_t segment = 0;  ///< from waypoint `segment` to the next one
  double fraction = 0;      ///< of that segment, in [0, 1]
  JointAngles at = {};
  LimitReason reason = LimitReason::end_of_range;
  /// For `contact`, the two faces that are nearest to meeting and their nearest points.
  std::optional<ContactWitness> contact = {};
  double distance_mm = 0;  ///< between these points
  std::size_t poses = 0;   ///< evaluated along the path
};

/// Follows paths of straight segments in the joint's angles. Several angles that change at once are a rotation
/// about no fixed axis, so there is no closed form; instead every step is as long as is certain to be free.
///
///     angle b          o waypoint 2
///       |     .  .   .
///       |   o  waypoint 1         steps shorten where surfaces come near:   o--------+---+--+-|
///       | .
///       o waypoint 0
///
/// On one segment the angles change by df, da, dr. With e1 and e3 at a right angle to e2, M turns by at most
/// W = sqrt(da^2 + (|df| + |dr|)^2) over the segment, so from a pose from which no rotation below c brings
/// anything together the next c / W of the segment are free.
///
/// Guarantee: the path is free up to the limit, whatever the surfaces do between two poses. The search ends if c
/// falls below the tolerance: a rotation by no more than that, about some axis, might then bring the surfaces
/// together, though not always the path itself: surfaces that pass that close count as in contact. A path along only
/// one angle is better computed as a motion, which is exact.
class PathFinder {
 public:
  /// Throws as RangeOfMotion does.
  explicit PathFinder(const Joint& joint, const RangeOptions& options = {});
  ~PathFinder();
  PathFinder(const PathFinder&) = delete;
  PathFinder& operator=(const PathFinder&) = delete;

  /// Throws UsageError for fewer than two waypoints, angles that are not finite, segments of more than a full
  /// turn, other angles than flexion on a hinge, or a tolerance below 1e-6 degrees.
  PathLimit limit(std::span<const JointAngles> waypoints, Angle tolerance = Angle::degrees(1e-3)) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace condyle
