#include <limits>
#include <utility>

#include "condyle/answer/case.hpp"
#include "condyle/error.hpp"

namespace condyle {
namespace {

using motion::NearestEnd, motion::RangeOfMotion;

bool is_free(const NearestEnd& nearest) noexcept {
  return nearest.end.reason != motion::LimitReason::contact_at_start &&
         nearest.end.reason != motion::LimitReason::strained_at_start;
}

PoseStanding standing_about_centre(const RangeOfMotion& limits, const JointAngles& at, bool in_contact,
                                   PoseStanding standing) {
  const bool knows_bearing = limits.bearing_rule() == motion::BearingRule::leave_out,
             meets = standing.clearance_mm == 0;
  const auto in_contact_unknown = [&] {
    standing.state = PoseState::contact;
    standing.why_unknown = limits.bearing().why_none;
    return standing;
  };
  if (meets && !knows_bearing) return in_contact_unknown();
  standing.nearest = limits.nearest_end(at);
  if (!standing.nearest || is_free(*standing.nearest)) {
    standing.state = standing.nearest && standing.nearest->end.turned <= at_limit_within ? PoseState::at_limit
                     : in_contact                                                        ? PoseState::bearing
                                                                                         : PoseState::free;
    return standing;
  }
  const bool is_strained = standing.nearest->end.reason == motion::LimitReason::strained_at_start;
  standing.nearest = limits.end_behind(at, at_limit_within);
  if (!standing.nearest && !is_strained && !knows_bearing) return in_contact_unknown();
  standing.state = standing.nearest        ? PoseState::at_limit
                   : is_strained && !meets ? PoseState::strained
                                           : PoseState::impinging;
  return standing;
}

}  // namespace

std::string_view name_of(PoseState state) noexcept {
  constexpr std::string_view names[] = {"free", "at_limit", "bearing", "impinging", "strained", "contact"};
  return names[static_cast<std::size_t>(state)];
}

double PoseStanding::to_limit_deg() const noexcept {
  if (nearest) return nearest->end.turned.degrees();
  const bool is_before = state == PoseState::free || state == PoseState::bearing;
  return is_before ? std::numeric_limits<double>::quiet_NaN() : 0;
}

std::shared_ptr<const RangeOfMotion> limits_of_poses(const Joint& joint) {
  try {
    return std::make_shared<const RangeOfMotion>(
        joint, motion::RangeOptions{.overlap = {.reference_contact = motion::ReferenceContact::accept}});
  } catch (const MeshError&) {
    return nullptr;
  }
}

PoseStanding pose_standing(const RangeOfMotion& limits, const JointAngles& at, const Vec3& translation_mm,
                           bool in_contact, PoseStanding::FindNearest find) {
  Pose X_FM = pose_at(limits.coordinates(), at);
  X_FM.translation() = translation_mm;
  PoseStanding standing{.clearance_mm = limits.clearance_mm(X_FM)};
  const bool knows_bearing = limits.bearing_rule() == motion::BearingRule::leave_out;
  if (find == PoseStanding::FindNearest::at_limits && (knows_bearing || !in_contact) &&
      !limits.may_end_within(at_limit_within, translation_mm, standing.clearance_mm)) {
    standing.state = in_contact ? PoseState::bearing : PoseState::free;
    return standing;
  }
  try {
    // What meets where nothing distinguishes it needs no limits.
    const bool is_as_made = translation_mm.isZero(0) || (standing.clearance_mm == 0 && !knows_bearing);
    return is_as_made ? standing_about_centre(limits, at, in_contact, standing)
                      : standing_about_centre(RangeOfMotion(limits, -translation_mm, Vec3::Zero()), at,
                                              in_contact, standing);
  } catch (const MeshError&) {  // the length of a ligament is not known there
    PoseStanding without = standing;
    without.state = standing.clearance_mm == 0 ? PoseState::impinging
                    : in_contact               ? PoseState::bearing
                                               : PoseState::free;
    return without;
  }
}

}  // namespace condyle
