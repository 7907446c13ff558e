#include "condyle/first_contact.hpp"

#include "boundary.hpp"

struct condyle_first_contact {
  condyle::motion::FirstContact contact;
};

namespace condyle::c {
namespace {

static_assert(static_cast<int>(motion::LimitReason::contact) == CONDYLE_CONTACT &&
              static_cast<int>(motion::LimitReason::end_of_range) == CONDYLE_END_OF_RANGE &&
              static_cast<int>(motion::LimitReason::contact_at_start) == CONDYLE_CONTACT_AT_START);
static_assert(static_cast<int>(motion::FeatureKind::vertex) == CONDYLE_VERTEX &&
              static_cast<int>(motion::FeatureKind::edge) == CONDYLE_EDGE &&
              static_cast<int>(motion::FeatureKind::face) == CONDYLE_FACE);

condyle_feature feature_of(const motion::Feature& feature) noexcept {
  return {static_cast<int>(feature.kind), feature.id, feature.other_end};
}

condyle_rotation_limit limit_of(const motion::Limit& limit) noexcept {
  condyle_rotation_limit out = {};
  out.turned_deg = limit.turned.degrees();
  out.error_bound_deg = limit.error_bound.degrees();
  out.reason = static_cast<int>(limit.reason);
  out.fixed_feature = out.mobile_feature = feature_of({});
  if (limit.contact) {
    out.has_witness = 1;
    out.fixed_feature = feature_of(limit.contact->fixed_feature);
    out.mobile_feature = feature_of(limit.contact->mobile_feature);
    copy(limit.contact->fixed_point, out.fixed_point_mm);
    copy(limit.contact->mobile_point, out.mobile_point_mm);
  }
  return out;
}

}  // namespace
}  // namespace condyle::c

using namespace condyle;

condyle_status condyle_first_contact_create(const condyle_mesh* fixed, const condyle_mesh* mobile,
                                            const double axis_point_mm[3], const double axis_direction[3],
                                            condyle_first_contact** first_contact) {
  return c::guarded([&] {
    condyle_first_contact*& out = c::required(first_contact, "first_contact");
    const AxisFrame axis(c::vector_of(axis_point_mm, "axis_point_mm"),
                         c::vector_of(axis_direction, "axis_direction"));
    out = new condyle_first_contact{
        motion::FirstContact(c::required(fixed, "fixed").mesh, c::required(mobile, "mobile").mesh, axis)};
  });
}

void condyle_first_contact_destroy(condyle_first_contact* first_contact) {
  delete first_contact;
}

condyle_status condyle_first_contact_limits(const condyle_first_contact* first_contact,
                                            const condyle_pose* X_FM, double negative_deg,
                                            double positive_deg, condyle_rotation_limit* negative,
                                            condyle_rotation_limit* positive) {
  return c::guarded([&] {
    const motion::FirstContact& contact = c::required(first_contact, "first_contact").contact;
    condyle_rotation_limit& out_negative = c::required(negative, "negative");
    condyle_rotation_limit& out_positive = c::required(positive, "positive");
    const motion::RotationLimits limits = contact.limits(
        c::pose_of(X_FM, "X_FM"), {Angle::degrees(negative_deg), Angle::degrees(positive_deg)});
    out_negative = c::limit_of(limits.negative);
    out_positive = c::limit_of(limits.positive);
  });
}
