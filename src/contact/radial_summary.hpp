#pragma once

#include <optional>

#include "contact/joint_contact.hpp"

/// The few numbers that a person reads of a RadialContact.

namespace condyle {

/// Depths are only comparable within their kind: along the ray, or along the arc about an axis.
enum class DepthKind { radial, tangential };

/// A radial depth is a depth where the surface faces the ray: then the way out along the ray is about the
/// shortest way out. Through a flat wall at 60 degrees from the ray it is twice as long; beyond that, or
/// where the ray leaves through the far end of a neck, the radial depth is a length along the bone and the
/// tangential depth is the one to read. docs/mathematics.md, section 2, has the angle; the ratio of lengths
/// says the same of curved walls too.
inline constexpr double longest_meaningful_ratio = 2;

struct DeepestVertex {
  Index vertex;
  double depth_mm;             ///< along its ray, > 0
  double shortest_way_out_mm;  ///< to the nearest point of the other body's surface
  Angle ray_to_normal;         ///< between the ray and the surface that it leaves through

  DepthKind applies() const noexcept {
    return ray_to_normal > oblique_ray || depth_mm > longest_meaningful_ratio * shortest_way_out_mm
               ? DepthKind::tangential
               : DepthKind::radial;
  }
};

/// One body's vertices against the other body.
struct RadialBodySummary {
  std::size_t vertices_inside = 0;
  std::size_t vertices_on_surface = 0;
  /// Of those inside, how many have a radial depth that is no depth.
  std::size_t oblique_inside = 0;
  std::optional<DeepestVertex> deepest;
  /// The deepest of those whose radial depth is a depth.
  std::optional<DeepestVertex> deepest_facing;
  /// Smallest gap of a vertex outside, mm; empty where no ray meets the other body.
  std::optional<double> min_gap_mm;
};

/// `points` are those that were asked of `other`, which gave `hits`.
RadialBodySummary summarise(const RadialResults& hits, PointsView points, const TriMesh& other);

/// Both bodies; empty where the other mesh is open.
struct RadialSummary {
  std::optional<RadialBodySummary> mobile, fixed;
};

/// `contact` is what joint.radial(X_FM) gave.
RadialSummary summarise(const JointContact& joint, const Pose& X_FM, const RadialContact& contact);

}  // namespace condyle
