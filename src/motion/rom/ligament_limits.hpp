#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "condyle/first_contact.hpp"
#include "condyle/joint.hpp"
#include "condyle/range_of_motion.hpp"
#include "core/arc_set.hpp"

namespace condyle::motion {

/// The ligaments of a joint that end motions.
class LigamentLimits {
 public:
  explicit LigamentLimits(const Joint& joint);

  /// With each slack length and each coordinate of a point that has a standard deviation displaced by so many of it, in the order of
  /// ligament_sigmas(), points of the fixed body first; as they are if none is given. A ligament keeps a thousandth of its slack length at least.
  LigamentLimits displaced(std::span<const double> standard_deviations) const;

  /// With the points and wraps of each moved with their bodies, in the frame of each.
  LigamentLimits shifted(const Vec3& fixed_by, const Vec3& mobile_by) const;

  bool empty() const noexcept { return ligaments_.empty(); }

  /// All angles of a full turn about this axis of the fixed body, from this pose, at which one has more strain than it may.
  core::ArcSet strained(const AxisFrame& axis_F, const Pose& X_FM) const;

  /// Ends either rotation where a ligament does before what ends it. Contact at the start stays what it is. Throws MeshError where an end of one
  /// goes into its wrap before that.
  void take_sooner(RotationLimits& limits, const AxisFrame& axis_F, const Pose& X_FM,
                   const RotationRange& range) const;

 private:
  std::vector<Ligament> ligaments_;
  std::vector<std::size_t> numbers_;  ///< in the joint
};

/// Where a ligament of the joint ends a motion, whatever bone does; at the end of its range none does. Throws as take_sooner().
Limit ligament_end(const Joint& joint, const Motion& motion);

/// Throws UsageError if a ligament of the joint ends motions, which `what` does not look for.
void refuse_ending_ligaments(const Joint& joint, const std::string& what);

}  // namespace condyle::motion
