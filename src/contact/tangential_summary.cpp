#include <algorithm>
#include <cmath>

#include "condyle/contact.hpp"

namespace condyle::contact {

TangentialBodySummary summarise(const tangential::TangentialResults& results) {
  TangentialBodySummary summary;
  for (Index i = 0; i < results.size(); ++i) {
    const Angle angle = results.angular_gap[i];
    const double arc = results.arc_gap_mm[i];
    switch (results.state[i]) {
      case PointState::inside: {
        ++summary.vertices_inside;
        if (!std::isfinite(angle.radians())) {
          ++summary.without_exit;
          break;
        }
        const DeepestRotation rotation{i, -angle, -arc};
        if (!summary.deepest || rotation.depth_mm > summary.deepest->depth_mm) summary.deepest = rotation;
        if (!summary.largest_angle || rotation.depth > summary.largest_angle->depth)
          summary.largest_angle = rotation;
        break;
      }
      case PointState::on_surface:
        ++summary.vertices_on_surface;
        summary.min_gap = Angle();
        summary.min_gap_mm = 0;
        break;
      case PointState::outside:
        if (!std::isfinite(angle.radians())) break;
        summary.min_gap = std::min(summary.min_gap.value_or(angle), angle);
        summary.min_gap_mm = std::min(summary.min_gap_mm.value_or(arc), arc);
        break;
    }
  }
  return summary;
}

}  // namespace condyle::contact
