#pragma once

#include "condyle/joint.hpp"
#include "condyle/pose.hpp"
#include "core/arc_set.hpp"

namespace condyle::motion {

/// Angles of a full turn of the mobile body at which a ligament has more strain than it may.
struct StrainedAngles {
  core::ArcSet beyond = {};
  /// Those of them at which an end of the ligament lies inside its wrap, so that its strain is not known.
  core::ArcSet unknown = {};
  /// How far an end of an arc may lie outside of what is strained.
  Angle error_bound = {};

  /// Whether an angle at which `beyond` begins or ends is one beyond which the length is not known.
  bool is_unknown_at(Angle end) const noexcept {
    const Angle near = error_bound + Angle::radians(1e-12);
    return unknown.contains(end) || unknown.contains(end + near) || unknown.contains(end - near);
  }
};

/// The mobile body starts at X_FM, in which the angle is 0, and turns about an axis of the fixed body's frame. The ligament has a strain that it
/// ends at. Closed form for a straight one and one over a sphere about a point of the axis; else a search that misses nothing:
/// docs/mathematics/14-ligaments.md.
StrainedAngles strained_angles(const Ligament& ligament, const AxisFrame& axis_F, const Pose& X_FM);

}  // namespace condyle::motion
