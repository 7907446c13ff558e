#include "contact/tangential_contact.hpp"

#include <algorithm>
#include <cmath>

namespace condyle {
namespace {

bool any_not_outside(const std::optional<TangentialResults>& hits) {
  return hits && std::any_of(hits->state.begin(), hits->state.end(),
                             [](PointState state) { return state != PointState::outside; });
}

}  // namespace

TangentialContact tangential_contact(const JointContact& joint, const Pose& X_FM, const Vec3& axis_F,
                                     TangentialRule rule) {
  TangentialContact contact;
  if (joint.fixed().is_closed()) {
    const RingTable fixed(joint.fixed(), AxisFrame(Vec3::Zero(), axis_F));
    contact.mobile_in_fixed = fixed.query(posed(X_FM, joint.mobile().vertices()), rule);
  }
  if (joint.mobile().is_closed()) {
    const Pose X_MF = X_FM.inverse();
    const RingTable mobile(joint.mobile(), AxisFrame(X_MF.translation(), X_MF.linear() * axis_F));
    contact.fixed_in_mobile = mobile.query(posed(X_MF, joint.fixed().vertices()), rule);
  }
  contact.pairs = joint.pairs(X_FM);
  contact.in_contact = !contact.pairs.empty() || any_not_outside(contact.mobile_in_fixed) ||
                       any_not_outside(contact.fixed_in_mobile);
  return contact;
}

TangentialBodySummary summarise(const TangentialResults& hits) {
  TangentialBodySummary summary;
  for (Index i = 0; i < hits.size(); ++i) {
    const Angle angle = hits.angular_gap[i];
    const double arc = hits.arc_gap_mm[i];
    switch (hits.state[i]) {
      case PointState::inside: {
        ++summary.vertices_inside;
        if (!std::isfinite(angle.radians())) {
          ++summary.without_way_out;
          break;
        }
        const DeepestTurn turn{i, -angle, -arc};
        if (!summary.deepest || turn.depth_mm > summary.deepest->depth_mm) summary.deepest = turn;
        if (!summary.largest_angle || turn.depth > summary.largest_angle->depth) summary.largest_angle = turn;
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

}  // namespace condyle
