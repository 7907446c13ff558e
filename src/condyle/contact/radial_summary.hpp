#pragma once

#include <optional>

#include "condyle/contact/joint_contact.hpp"

/// The few numbers that a person reads of a RadialContact.

namespace condyle {

/// Depths are only comparable within their kind: along the ray, or along the arc about an axis.
enum class DepthKind { radial, tangential };

struct DeepestVertex {
  Index vertex;
  double depth_mm;      ///< along its ray, > 0
  Angle ray_to_normal;  ///< between the ray and the surface that it leaves through
};

/// One body's vertices against the other body.
struct RadialBodySummary {
  std::size_t vertices_inside = 0;
  std::size_t vertices_on_surface = 0;
  /// Of those inside, how many see the surface at more than `oblique_ray`: their radial depth is a length
  /// along the wall, not a depth.
  std::size_t oblique_inside = 0;
  std::optional<DeepestVertex> deepest;
  /// The deepest of those whose radial depth is a depth.
  std::optional<DeepestVertex> deepest_facing;
  /// Smallest gap of a vertex outside, mm; empty where no ray meets the other body.
  std::optional<double> min_gap_mm;

  /// Which depth to read at the deepest vertex.
  DepthKind applies() const noexcept {
    return deepest && deepest->ray_to_normal > oblique_ray ? DepthKind::tangential : DepthKind::radial;
  }
};

RadialBodySummary summarise(const RadialHits& hits);

}  // namespace condyle
