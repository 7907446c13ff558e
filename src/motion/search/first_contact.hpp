#pragma once

#include <compare>
#include <optional>
#include <vector>

#include "condyle/first_contact.hpp"
#include "motion/search/rotation_table.hpp"

namespace condyle::motion {

/// Features of the two bodies of a rotation, whichever of F and M turns.
struct FeaturePair {
  Feature rotating, stationary;
  friend auto operator<=>(const FeaturePair&, const FeaturePair&) = default;
};

/// How far the rotating body rotates about the axis either way from its start, until the surfaces meet or the
/// range ends; guarantee as of FirstContact. In witnesses the stationary body is called fixed, the rotating one
/// mobile. The range must satisfy RotationRange.
///
/// Deterministic: the same input gives the same bits on any thread.
RotationLimits first_contact(const RotationTable& stationary, RotatingBody& rotating,
                             const RotationRange& range = {});
/// Leaves of the two trees in which contact was found.
struct MetLeaves {
  Index rotating, stationary;
};
struct LeavesAtEnds {
  std::optional<MetLeaves> negative, positive;
};
/// The same for a body that rests for a few searches only, at the pose where it starts: made ready as far as they look. Leaves that met first in a
/// search much like this one are compared first, which bounds it and changes nothing of what it finds; where it ends is written over them.
RotationLimits first_contact(RotatingBody& stationary, RotatingBody& rotating,
                             const RotationRange& range = {}, LeavesAtEnds* leaves = nullptr);

/// A feature of the rotating body where it first meets the stationary one.
struct FeatureContact {
  Feature feature;
  Angle turned;
  Vec3 point;  ///< in the rotating body's own frame, mm
};

/// Every feature of the rotating body that meets the stationary one on the way, once, in the order in which they do; of those at the same
/// angle the lesser Feature first. As exact as first_contact(), and as long as one that meets nothing, if few do. The bodies must be free
/// at the start.
std::vector<FeatureContact> feature_contacts(const RotationTable& stationary, RotatingBody& rotating,
                                             RotationSense sense, Angle range);

}  // namespace condyle::motion
