#include "condyle/first_contact.hpp"

#include <limits>
#include <vector>

#include "boundary.hpp"
#include "condyle/answer.hpp"
#include "joint_contact.hpp"

struct condyle_first_contact {
  condyle::motion::FirstContact contact;
};

struct condyle_free_results {
  bool has_answer = false;
  std::vector<condyle_free_interval> intervals = {};
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

constexpr double endless = std::numeric_limits<double>::infinity();

/// `beyond` is where an end lies that nothing ends.
condyle_slide_limit slide_limit_of(const motion::SlideEnd& end, bool free_at_start, double beyond) noexcept {
  condyle_slide_limit out = {};
  out.moved_mm = end.at_mm.value_or(beyond);
  out.error_bound_mm = end.error_bound_mm;
  out.reason = !free_at_start ? CONDYLE_CONTACT_AT_START : end.at_mm ? CONDYLE_CONTACT : CONDYLE_END_OF_RANGE;
  out.fixed_triangle = out.mobile_triangle = no_index;
  if (end.contact) {
    out.has_witness = 1;
    out.fixed_triangle = end.contact->fixed_feature.id, out.mobile_triangle = end.contact->mobile_feature.id;
    copy(end.contact->fixed_point, out.fixed_point_mm);
    copy(end.contact->mobile_point, out.mobile_point_mm);
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

condyle_status condyle_free_results_create(condyle_free_results** results) {
  return c::make(results, "results");
}

void condyle_free_results_destroy(condyle_free_results* results) {
  delete results;
}

condyle_status condyle_joint_contact_turn(const condyle_joint_contact* contact, const condyle_pose* X_FM,
                                          const double axis_point_mm[3], const double axis_direction[3],
                                          condyle_rotation_limit* negative, condyle_rotation_limit* positive,
                                          condyle_free_results* results) {
  return c::guarded([&] {
    condyle_free_results& out = c::required(results, "results");
    out.has_answer = false;
    const contact::JointContact& joint = c::required(contact, "contact").joint;
    condyle_rotation_limit& out_negative = c::required(negative, "negative");
    condyle_rotation_limit& out_positive = c::required(positive, "positive");
    const TurnRequest request{c::vector_of(axis_direction, "axis_direction"),
                              c::vector_of(axis_point_mm, "axis_point_mm"), c::pose_of(X_FM, "X_FM")};
    const motion::FreeAngles free = answer_turn(joint.fixed(), joint.mobile(), request).free;
    out.intervals.clear();
    for (const motion::FreeInterval& each : free.intervals)
      out.intervals.push_back({each.low.degrees(), each.high.degrees(), each.at_low.error_bound.degrees(),
                               each.at_high.error_bound.degrees()});
    out_negative = c::limit_of(free.from_start.negative);
    out_positive = c::limit_of(free.from_start.positive);
    out.has_answer = true;
  });
}

condyle_status condyle_joint_contact_slide(const condyle_joint_contact* contact, const condyle_pose* X_FM,
                                           const double direction[3], condyle_slide_limit* negative,
                                           condyle_slide_limit* positive, condyle_free_results* results) {
  return c::guarded([&] {
    condyle_free_results& out = c::required(results, "results");
    out.has_answer = false;
    const contact::JointContact& joint = c::required(contact, "contact").joint;
    condyle_slide_limit& out_negative = c::required(negative, "negative");
    condyle_slide_limit& out_positive = c::required(positive, "positive");
    const SlideRequest request{c::vector_of(direction, "direction"), c::pose_of(X_FM, "X_FM")};
    const motion::FreeSlides free = answer_slide(joint.fixed(), joint.mobile(), request).free;
    out.intervals.clear();
    for (const motion::FreeSlide& each : free.intervals)
      out.intervals.push_back({each.low.at_mm.value_or(-c::endless), each.high.at_mm.value_or(c::endless),
                               each.low.error_bound_mm, each.high.error_bound_mm});
    out_negative = c::slide_limit_of(free.negative, free.free_at_start, -c::endless);
    out_positive = c::slide_limit_of(free.positive, free.free_at_start, c::endless);
    out.has_answer = true;
  });
}

condyle_status condyle_free_results_intervals(const condyle_free_results* results,
                                              const condyle_free_interval** intervals,
                                              size_t* interval_count) {
  return c::guarded([&] {
    const std::vector<condyle_free_interval>& found = c::answered(results).intervals;
    const condyle_free_interval*& first = c::required(intervals, "intervals");
    c::required(interval_count, "interval_count") = found.size();
    first = found.data();
  });
}
