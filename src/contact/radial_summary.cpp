#include "condyle/contact.hpp"

#include <cmath>

#include "condyle/contact_measures.hpp"
#include "contact/body_pair.hpp"
#include "core/coordinate_range.hpp"
#include "mesh/surface_distance.hpp"

namespace condyle::contact {
namespace {

/// `distance_of` gives the nearest distance of a vertex that is inside.
RadialBodySummary summary_of(const radial::RadialResults& results, const auto& distance_of) {
  RadialBodySummary summary;
  const auto deepen = [](std::optional<DeepestVertex>& deepest, const DeepestVertex& candidate) {
    if (!deepest || candidate.depth_mm > deepest->depth_mm) deepest = candidate;
  };
  for (Index i = 0; i < results.size(); ++i) {
    const double gap = results.radial_gap_mm[i];
    switch (results.state[i]) {
      case PointState::inside: {
        ++summary.vertices_inside;
        const DeepestVertex vertex{i, -gap, distance_of(i), results.ray_to_normal[i]};
        deepen(summary.deepest, vertex);
        if (vertex.radial_is_depth())
          deepen(summary.deepest_facing, vertex);
        else
          ++summary.oblique_inside;
        break;
      }
      case PointState::on_surface:
        ++summary.vertices_on_surface;
        summary.min_gap_mm = 0;
        break;
      case PointState::outside:
        if (std::isfinite(gap) && (!summary.min_gap_mm || gap < *summary.min_gap_mm))
          summary.min_gap_mm = gap;
        break;
    }
  }
  return summary;
}

}  // namespace

RadialBodySummary summarise(const radial::RadialResults& results, PointsView points, const Mesh& other) {
  std::optional<mesh::SurfaceDistance> distance;  // made if a vertex is inside
  return summary_of(results, [&](Index v) {
    if (!distance) distance.emplace(other);
    return (*distance)(points[v]);
  });
}

RadialSummary summarise(const JointContact& joint, const Pose& X_FM, const RadialContact& contact) {
  core::require_rotation(X_FM);
  const BodyPair& bodies = contact::body_pair_of(joint);
  RadialSummary summary;
  if (contact.mobile_in_fixed)
    summary.mobile = summary_of(*contact.mobile_in_fixed, [&](Index v) {
      return mesh::distance_to_surface(bodies.fixed_tree(), posed(X_FM, joint.mobile().vertices()[v]));
    });
  if (contact.fixed_in_mobile) {
    const Pose X_MF = inverted(X_FM);
    summary.fixed = summary_of(*contact.fixed_in_mobile, [&](Index v) {
      return mesh::distance_to_surface(bodies.mobile_tree(), posed(X_MF, joint.fixed().vertices()[v]));
    });
  }
  return summary;
}

RadialSummary summarise(const RadialContact& contact, const NearestDistances& distances) {
  RadialSummary summary;
  if (contact.mobile_in_fixed)
    summary.mobile = summary_of(*contact.mobile_in_fixed, [&](Index v) { return distances.mobile[v]; });
  if (contact.fixed_in_mobile)
    summary.fixed = summary_of(*contact.fixed_in_mobile, [&](Index v) { return distances.fixed[v]; });
  return summary;
}

}  // namespace condyle::contact
