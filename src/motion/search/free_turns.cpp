#include <algorithm>

#include "condyle/first_contact.hpp"
#include "contact/body_pair.hpp"
#include "core/coordinate_range.hpp"
#include "core/rotation_about.hpp"
#include "motion/search/add_free_interval.hpp"
#include "motion/search/contact_set.hpp"
#include "motion/search/first_contact.hpp"
#include "motion/search/start_contact.hpp"

namespace condyle::motion {
namespace {

Pose turned_about(const AxisFrame& axis, Angle by, const Pose& X) {
  const Eigen::Matrix3d R = core::rotation_about(axis.direction(), by.radians());
  Pose turned = Pose::Identity();
  turned.linear() = R * X.linear();
  turned.translation() = axis.point() + R * (X.translation() - axis.point());
  return turned;
}

/// Ends the interval that holds the start there, as bodies that touch do.
void touch_at_start(const ContactWitness& touching, FreeAngles& free) {
  const Limit start{.reason = LimitReason::contact_at_start, .contact = touching};
  const Angle turn = Angle::degrees(360);
  FreeInterval before = free.intervals.front(), after = before;
  if (free.from_start.positive.reason == LimitReason::end_of_range) {
    free.intervals = {{Angle(), turn, start, start}};
  } else {
    free.intervals.erase(free.intervals.begin());
    before.low = before.low + turn, before.high = turn, before.at_high = start;
    after.low = Angle(), after.at_low = start;
    if (after.high > narrowest_free_turn) free.intervals.insert(free.intervals.begin(), after);
    if (turn - before.low > narrowest_free_turn) free.intervals.push_back(before);
  }
  free.from_start.negative = free.from_start.positive = start;
}

/// Computes them for vertices as they are rounded into the frame of the axis.
FreeAngles free_turns_in_its_frame(const Mesh& fixed, const Mesh& mobile, const AxisFrame& axis_F,
                                   const Pose& X_FM) {
  core::require_rotation(X_FM);
  const FeatureTree fixed_tree(fixed), mobile_tree(mobile);
  const RotationTable table(fixed_tree, axis_F);
  RotatingBody rotating(mobile_tree);
  rotating.start_at(axis_F, X_FM);
  FreeAngles free{motion::first_contact(table, rotating), {}};
  const auto& [negative, positive, work] = free.from_start;
  std::vector<core::Arc> known;
  if (free.from_start.free_at_start()) {
    if (positive.reason == LimitReason::end_of_range) {
      const Angle half = Angle::degrees(180);
      free.intervals.push_back({-half, half, negative, positive});
      return free;
    }
    known.push_back({-negative.turned, negative.turned + positive.turned});
    free.intervals.push_back({-negative.turned, positive.turned, negative, positive});
  }
  for (const core::Arc& gap : motion::contact_set(table, rotating, core::ArcSet(known)).complement().arcs()) {
    if (!(gap.width > narrowest_free_turn)) continue;
    // The gap is free or, one body inside the other, all contact; its ends are computed as first contacts are.
    const Angle middle = gap.start + gap.width * 0.5;
    rotating.start_at(axis_F, turned_about(axis_F, middle, X_FM));
    const RotationLimits both = motion::first_contact(table, rotating);
    if (both.free_at_start()) add_free_interval(free.intervals, middle, both);
  }
  std::sort(free.intervals.begin(), free.intervals.end(),
            [](const FreeInterval& a, const FreeInterval& b) { return a.low < b.low; });
  return free;
}

}  // namespace

FreeAngles free_turns(const Mesh& fixed, const Mesh& mobile, const AxisFrame& axis_F, const Pose& X_FM) {
  FreeAngles free = free_turns_in_its_frame(fixed, mobile, axis_F, X_FM);
  if (!free.from_start.free_at_start()) return free;
  if (const auto touching = faces_touching(contact::BodyPair(fixed, mobile), fixed, mobile, X_FM))
    touch_at_start(*touching, free);
  return free;
}

}  // namespace condyle::motion
