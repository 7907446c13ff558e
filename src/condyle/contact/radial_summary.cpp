#include "condyle/contact/radial_summary.hpp"

#include <cmath>

namespace condyle {

RadialBodySummary summarise(const RadialHits& hits) {
  RadialBodySummary summary;
  const auto deepen = [](std::optional<DeepestVertex>& deepest, const DeepestVertex& candidate) {
    if (!deepest || candidate.depth_mm > deepest->depth_mm) deepest = candidate;
  };
  for (Index i = 0; i < hits.size(); ++i) {
    const double gap = hits.radial_gap[i];
    switch (hits.state[i]) {
      case PointState::inside: {
        ++summary.vertices_inside;
        const DeepestVertex vertex{i, -gap, Angle::radians(hits.ray_to_normal[i])};
        deepen(summary.deepest, vertex);
        if (vertex.ray_to_normal > oblique_ray) {
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

}  // namespace condyle
