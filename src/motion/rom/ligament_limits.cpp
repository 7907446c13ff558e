#include "motion/rom/ligament_limits.hpp"

#include <algorithm>

#include "condyle/error.hpp"
#include "core/formatted.hpp"
#include "kinematics/ligament_path.hpp"
#include "motion/events/ligament_end.hpp"

namespace condyle::motion {
namespace {

/// How far it is from 0 to the first of these angles, backwards or on; a full turn if there are none. They do not hold 0.
Angle distance_to(const core::ArcSet& angles, RotationSense sense) {
  const std::vector<core::Arc> arcs = angles.arcs();
  if (arcs.empty()) return Angle::radians(two_pi);
  return sense == RotationSense::positive ? arcs.front().start
                                          : Angle::radians(two_pi) - (arcs.back().start + arcs.back().width);
}

}  // namespace

LigamentLimits::LigamentLimits(const Joint& joint) {
  for (std::size_t i = 0; i < joint.ligaments.size(); ++i)
    if (joint.ligaments[i].ends_at_strain) {
      ligaments_.push_back(joint.ligaments[i]);
      numbers_.push_back(i);
    }
}

LigamentLimits LigamentLimits::displaced(std::span<const double> standard_deviations) const {
  LigamentLimits out = *this;
  if (standard_deviations.empty()) return out;
  std::size_t k = 0;
  for (Ligament& ligament : out.ligaments_) {
    if (ligament.slack_sigma_mm > 0) {
      const double moved = ligament.slack_length_mm + standard_deviations[k++] * ligament.slack_sigma_mm;
      ligament.slack_length_mm = std::max(moved, ligament.slack_length_mm / 1000);
    }
    if (!(ligament.point_sigma_mm > 0)) continue;
    for (std::vector<Vec3>* points : {&ligament.fixed, &ligament.mobile})
      for (Vec3& point : *points)
        for (double& coordinate : point) coordinate += standard_deviations[k++] * ligament.point_sigma_mm;
  }
  return out;
}

LigamentLimits LigamentLimits::shifted(const Vec3& fixed_by, const Vec3& mobile_by) const {
  LigamentLimits out = *this;
  for (Ligament& ligament : out.ligaments_) kinematics::shift(ligament, fixed_by, mobile_by);
  return out;
}

core::ArcSet LigamentLimits::strained(const AxisFrame& axis_F, const Pose& X_FM) const {
  core::ArcSet all;
  for (const Ligament& ligament : ligaments_)
    all = all.united(strained_angles(ligament, axis_F, X_FM).beyond);
  return all;
}

void LigamentLimits::take_sooner(RotationLimits& limits, const AxisFrame& axis_F, const Pose& X_FM,
                                 const RotationRange& range) const {
  if (limits.positive.reason == LimitReason::contact_at_start) return;
  for (std::size_t i = 0; i < ligaments_.size(); ++i) {
    const StrainedAngles angles = strained_angles(ligaments_[i], axis_F, X_FM);
    const auto require_known = [&](Angle at) {
      if (angles.is_unknown_at(at))
        throw MeshError(
            core::formatted("ligament %s: %.2f degrees on its end lies inside its wrap, and its "
                            "length is not known from there on",
                            ligaments_[i].name.c_str(), at.degrees()));
    };
    if (angles.beyond.contains(Angle())) {
      require_known(Angle());
      for (Limit* end : {&limits.negative, &limits.positive})
        *end = {.reason = LimitReason::strained_at_start, .ligament = numbers_[i]};
      return;
    }
    const auto take = [&](Limit& end, RotationSense sense, Angle within) {
      const Angle turned = distance_to(angles.beyond, sense);
      if (turned > within || turned >= end.turned) return;
      require_known(turned * sign_of(sense));
      end = {.turned = turned,
             .reason = LimitReason::ligament,
             .error_bound = angles.error_bound,
             .ligament = numbers_[i]};
    };
    take(limits.negative, RotationSense::negative, -range.negative);
    take(limits.positive, RotationSense::positive, range.positive);
  }
}

Limit ligament_end(const Joint& joint, const Motion& motion) {
  const bool grows = motion.sense == RotationSense::positive;
  RotationLimits ends;
  for (Limit* end : {&ends.negative, &ends.positive}) end->turned = motion.range;
  const CoordinateSystem system = joint.coordinates();
  LigamentLimits(joint).take_sooner(ends, {Vec3::Zero(), axis_of(motion.vary, system, motion.start)},
                                    pose_at(system, motion.start),
                                    {grows ? Angle() : -motion.range, grows ? motion.range : Angle()});
  return grows ? ends.positive : ends.negative;
}

void refuse_ending_ligaments(const Joint& joint, const std::string& what) {
  for (const Ligament& ligament : joint.ligaments)
    if (ligament.ends_at_strain)
      throw UsageError("ligament " + ligament.name + " ends motions, which " + what + " does not look for");
}

}  // namespace condyle::motion
