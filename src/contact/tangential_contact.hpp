#pragma once

#include <optional>
#include <vector>

#include "contact/joint_contact.hpp"
#include "condyle/tangential.hpp"

namespace condyle {

/// Everything about two bodies in one pose, by the tangential method about one axis through the joint centre.
struct TangentialContact {
  /// Every mobile vertex against the fixed body; empty where the fixed mesh is open. A positive turn is one
  /// of the mobile body about the axis.
  std::optional<TangentialResults> mobile_in_fixed;
  /// Every fixed vertex against the mobile body; empty where the mobile mesh is open. A positive turn is one
  /// of the fixed body about the axis: that is the opposite movement.
  std::optional<TangentialResults> fixed_in_mobile;
  /// The exact set of intersecting triangle pairs, ascending.
  std::vector<TrianglePair> pairs;
  /// Whether the bodies share a point: surfaces that meet, or one body wholly inside the other.
  bool in_contact = false;
};

/// The axis is given in F, of any length but zero, and passes through the joint centre. Two ring tables are
/// built for it, which is the larger part of the cost.
TangentialContact tangential_contact(const JointContact& joint, const Pose& X_FM, const Vec3& axis_F,
                                     TangentialRule rule = TangentialRule::alternating);

/// A vertex and how far it must turn to be free.
struct DeepestTurn {
  Index vertex;
  Angle depth;
  double depth_mm;  ///< arc length at the vertex's own radius
};

/// One body's vertices against the other body.
struct TangentialBodySummary {
  std::size_t vertices_inside = 0;
  std::size_t vertices_on_surface = 0;
  /// Of those inside, how many no turn about the axis sets free: their whole circle is solid.
  std::size_t without_way_out = 0;
  /// Of the others, the one whose way out is longest in mm, and the one whose way out is the largest angle: a
  /// vertex near the axis turns far without moving much.
  std::optional<DeepestTurn> deepest, largest_angle;
  /// Smallest angle and smallest arc between a vertex outside and the other body, not always of one vertex;
  /// empty where no circle meets it.
  std::optional<Angle> min_gap;
  std::optional<double> min_gap_mm;
};

TangentialBodySummary summarise(const TangentialResults& hits);

}  // namespace condyle
