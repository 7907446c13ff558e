#include <fmt/format.h>

#include <memory>
#include <optional>

#include "condyle/range_of_motion.hpp"
#include "goals.hpp"
#include "method.hpp"
#include "questions.hpp"
#include "stepping.hpp"
#include "timing.hpp"

namespace bench {
namespace {

using condyle::Angle;
using condyle::Joint;
using condyle::motion::Motion;
using condyle::motion::MotionLimit;
using condyle::motion::RangeOfMotion;

constexpr Angle step = Angle::degrees(0.1);
/// Wide enough to be a cheap way to a bracket, as people do before they bisect.
constexpr Angle bracket_step = Angle::degrees(1);
/// Moves a point 0.2 m from the axis by 3.5e-6 mm. Bisecting ends there, and there FCL is asked again.
constexpr Angle certificate = Angle::degrees(1e-6);
/// One limit is too short to be timed alone.
constexpr int limits_per_sample = 20;

const TableHead building_head = {"first_contact_building",
                                 "First contact: made ready for a joint, once; processor time",
                                 {{"scene", "scene"},
                                  {"fixed_triangles", "fixed triangles"},
                                  {"mobile_triangles", "mobile triangles"},
                                  {"condyle_ms", "Condyle, ms"},
                                  {"fcl_ms", "FCL, ms"}}};

const TableHead times_head = {"first_contact",
                              "First contact: one limit, made ready before; processor time, one thread",
                              {{"scene", "scene"},
                               {"motion", "motion"},
                               {"condyle_ms", "Condyle, ms"},
                               {"stepping_ms", "FCL by 0.1°, ms"},
                               {"stepping_queries", "queries"},
                               {"stepping_ratio", "ratio"},
                               {"bisecting_ms", "FCL bisected, ms"},
                               {"bisecting_queries", "queries"},
                               {"bisecting_ratio", "ratio"},
                               {"bisecting_ratio_with_building", "ratio, both with building"}}};

const TableHead agreement_head = {"first_contact_agreement",
                                  "First contact: do they agree",
                                  {{"scene", "scene"},
                                   {"motion", "motion"},
                                   {"limit_deg", "limit, °", 10},
                                   {"free_deg", "FCL free at, °", 6},
                                   {"touching_deg", "touching at, °", 6},
                                   {"bracket_holds_limit", "limit between"},
                                   {"bisected_minus_limit_deg", "bisected - limit, °", 2},
                                   {"free_just_before", "FCL free 1e-6° before"},
                                   {"touching_just_after", "touching 1e-6° after"}}};

/// The joint made ready as a caller does who knows its bearing surface, any contact to count as it does for the others;
/// a limit is asked once, for the first one on a thread makes room for the body that turns.
std::unique_ptr<RangeOfMotion> ready(const Joint& joint, const condyle::motion::BearingOptions& bearing,
                                     const Motion& motion) {
  auto range = std::make_unique<RangeOfMotion>(
      joint, condyle::motion::RangeOptions{.bearing = bearing, .overlap = {}});
  (void)range->limit(motion);
  return range;
}

std::string yes_or_no(bool yes) {
  return yes ? "yes" : "no";
}

struct Building {
  double condyle_seconds, fcl_seconds;
};

Building ask_building(const Joint& joint, const condyle::motion::BearingOptions& bearing,
                      const MethodKind& fcl, int rounds, Report& report) {
  const Motion motion = condyle::motion::hip_motions().front();
  const auto samples = interleaved(rounds, {[&] { ready(joint, bearing, motion); },
                                            [&] {
                                              fcl.make({joint.fixed.mesh, joint.mobile.mesh});
                                            }});
  const Building building{median(samples[0]), median(samples[1])};
  report.table(building_head)
      .add({joint.name, static_cast<std::int64_t>(joint.fixed.mesh.triangles().size()),
            static_cast<std::int64_t>(joint.mobile.mesh.triangles().size()), building.condyle_seconds * 1e3,
            building.fcl_seconds * 1e3});
  return building;
}

void ask_limit(const Motion& motion, const Joint& joint, const RangeOfMotion& range, Method& fcl,
               const Building& building, int rounds, Report& report) {
  const double sign = motion.sense == condyle::RotationSense::positive ? 1 : -1;
  const TouchAt touch = [&](Angle turn) {
    return fcl.touch(condyle::pose_at(joint.coordinates(),
                                      condyle::motion::turned_by(motion.start, motion.vary, turn * sign)));
  };

  MotionLimit limit;
  std::optional<Bracket> stepped, bisection;
  const auto samples = interleaved(rounds, {
                                               [&] {
                                                 for (int i = 0; i < limits_per_sample; ++i)
                                                   limit = range.limit(motion);
                                               },
                                               [&] { stepped = step_to_contact(touch, step, motion.range); },
                                               [&] {
                                                 bisection =
                                                     step_to_contact(touch, bracket_step, motion.range);
                                                 if (bisection)
                                                   bisection = bisected(touch, *bisection, certificate);
                                               },
                                           });
  if (limit.end.reason != condyle::motion::LimitReason::contact || !stepped || !bisection) {
    report.disagreements.push_back(fmt::format("{}, {}: not both find a contact", joint.name, motion.name));
    return;
  }

  const double ours = median(samples[0]) / limits_per_sample;
  const double stepping = median(samples[1]), bisecting = median(samples[2]);
  report.table(times_head)
      .add({joint.name, motion.name, ours * 1e3, stepping * 1e3, std::int64_t{stepped->queries},
            stepping / ours, bisecting * 1e3, std::int64_t{bisection->queries}, bisecting / ours,
            (bisecting + building.fcl_seconds) / (ours + building.condyle_seconds)});

  add_goal({"first contact, stepping FCL OBBRSS: " + motion.name, joint.name, Bound::at_least, 100,
            "times cheaper"},
           stepping / ours, report);
  add_goal({"first contact with building, bisecting FCL: " + motion.name, joint.name, Bound::at_least, 5,
            "times cheaper"},
           (bisecting + building.fcl_seconds) / (ours + building.condyle_seconds), report);

  if (motion.name == "flexion")
    report.ratios[fmt::format("first_contact/{}/fcl_obbrss_bisected_with_building", joint.name)] =
        (bisecting + building.fcl_seconds) / (ours + building.condyle_seconds);

  const bool holds = stepped->holds(limit.end.turned);
  if (!holds)
    report.disagreements.push_back(
        fmt::format("{}, {}: the limit {} is not between {} and {}, where FCL steps", joint.name, motion.name,
                    limit.end.turned.degrees(), stepped->free.degrees(), stepped->touching.degrees()));
  report.table(agreement_head)
      .add({joint.name, motion.name, limit.end.turned.degrees(), stepped->free.degrees(),
            stepped->touching.degrees(), yes_or_no(holds), (bisection->touching - limit.end.turned).degrees(),
            yes_or_no(!touch(limit.end.turned - certificate)),
            yes_or_no(touch(limit.end.turned + certificate))});
}

}  // namespace

void ask_first_contact(const Scene& scene, Effort effort, Report& report) {
  const condyle::Joint& joint = scene.joint;
  const auto kind = method_named("fcl_obbrss");
  if (!kind) {
    report.skipped.push_back(fmt::format("first_contact/{}: FCL is not there", joint.name));
    return;
  }
  const int rounds = effort == Effort::full ? 3 : 1;
  const condyle::motion::BearingOptions bearing{
      .rule = condyle::motion::BearingRule::count,
      .surface = condyle::motion::find_bearing_surface(joint).surface};
  const Building building = ask_building(joint, bearing, *kind, rounds, report);
  const std::vector<Motion> motions = condyle::motion::hip_motions();
  const auto range = ready(joint, bearing, motions.front());
  const auto fcl = kind->make({joint.fixed.mesh, joint.mobile.mesh});
  for (const auto* name : {"flexion", "internal_rotation_at_90_flexion"})
    ask_limit(condyle::motion::motion_named(motions, name), joint, *range, *fcl, building, rounds, report);
}

}  // namespace bench
