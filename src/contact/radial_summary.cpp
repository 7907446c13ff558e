#include "condyle/contact.hpp"

#include <cmath>

#include "mesh/surface_distance.hpp"

namespace condyle {

RadialBodySummary summarise(const RadialResults& results, PointsView points, const Mesh& other) {
  RadialBodySummary summary;
  std::optional<mesh::SurfaceDistance> distance;  // built where a vertex is inside
  const auto deepen = [](std::optional<DeepestVertex>& deepest, const DeepestVertex& candidate) {
    if (!deepest || candidate.depth_mm > deepest->depth_mm) deepest = candidate;
  };
  for (Index i = 0; i < results.size(); ++i) {
    const double gap = results.radial_gap_mm[i];
    switch (results.state[i]) {
      case PointState::inside: {
        ++summary.vertices_inside;
        if (!distance) distance.emplace(other);
        const DeepestVertex vertex{i, -gap, (*distance)(points[i]), results.ray_to_normal[i]};
        deepen(summary.deepest, vertex);
        if (vertex.applies() == DepthKind::tangential) {
          ++summary.oblique_inside;
        } else {
          deepen(summary.deepest_facing, vertex);
        }
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

RadialSummary summarise(const JointContact& joint, const Pose& X_FM, const RadialContact& contact) {
  RadialSummary summary;
  if (contact.mobile_in_fixed) {
    summary.mobile =
        summarise(*contact.mobile_in_fixed, posed(X_FM, joint.mobile().vertices().view()), joint.fixed());
  }
  if (contact.fixed_in_mobile) {
    summary.fixed = summarise(*contact.fixed_in_mobile,
                              posed(inverted(X_FM), joint.fixed().vertices().view()), joint.mobile());
  }
  return summary;
}

}  // namespace condyle
