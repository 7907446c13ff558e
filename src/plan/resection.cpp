#include "condyle/resection.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <string_view>
#include <tuple>

#include "condyle/error.hpp"
#include "core/formatted.hpp"
#include "kinematics/hip_parts.hpp"
#include "kinematics/posed_parts.hpp"
#include "motion/rom/ligament_limits.hpp"
#include "plan/bone_cut.hpp"
#include "plan/check_target.hpp"
#include "plan/cut_for.hpp"
#include "plan/planned.hpp"

namespace condyle::plan {
namespace {

using plan::BoneCut;
using plan::CutTarget;

/// What is added to the name of a joint that was cut.
constexpr std::string_view resected = ", resected";

std::string degrees(Angle angle) {
  return core::formatted("%.6g", angle.degrees());
}

void check_kept(const KeptBone& kept, const Body& body) {
  if (kept.deepest_mm && !(*kept.deepest_mm > 0 && std::isfinite(*kept.deepest_mm)))
    throw UsageError("resection: the largest depth must be above 0 mm");
  if (kept.within_mm && !(*kept.within_mm >= 0 && std::isfinite(*kept.within_mm)))
    throw UsageError("resection: the distance from the bearing surface must be 0 mm or more");
  if (!kept.vertices.empty() && kept.vertices.size() != body.mesh.vertices().size())
    throw UsageError("resection: " + std::to_string(kept.vertices.size()) + " marks of vertices for the " +
                     std::to_string(body.mesh.vertices().size()) + " of " + body.name);
}

}  // namespace

std::string_view name_of(KeptBy by) noexcept {
  switch (by) {
    case KeptBy::bearing:
      return "bearing";
    case KeptBy::depth:
      return "depth";
    case KeptBy::zone:
      return "zone";
    case KeptBy::marked:
      break;
  }
  return "marked";
}

void check_target(const ReachTarget& target) {
  const auto& [motion, reach, is_gain] = target;
  if (is_gain && !(reach > Angle()))
    throw UsageError("resection: " + motion.name + " is to gain " + degrees(reach) +
                     " degrees: a gain is above 0");
  if (!is_gain && !(reach > Angle() && reach <= motion.range))
    throw UsageError("resection: " + motion.name + " cannot reach " + degrees(reach) +
                     " degrees: its range is above 0 and at most " + degrees(motion.range));
}

void check_resection(const Joint& joint, const ResectionOptions& request) {
  if (request.targets.empty()) throw UsageError("resection: no motion has a target to reach");
  if (joint.implant)
    throw UsageError("resection: the joint has an implant, and a cut does not know it from bone");
  std::set<std::string_view> names;
  for (const ReachTarget& target : request.targets) {
    const motion::Motion& motion = target.motion;
    motion::check_motion(motion, joint.kind);
    if (!names.insert(motion.name).second) throw UsageError("resection: " + motion.name + " has two targets");
    check_target(target);
  }
  if (!(request.fixed_share >= 0 && request.fixed_share <= 1))
    throw UsageError("resection: the share of the fixed body must be from 0 to 1");
  if (!(request.margin_mm >= 0 && request.margin_mm <= 10))
    throw UsageError("resection: the margin must be from 0 to 10 mm");
  if (request.burr_mm && !(*request.burr_mm >= 0.5 && *request.burr_mm <= 30))
    throw UsageError("resection: the burr's diameter must be from 0.5 to 30 mm");
  if (!(request.edge_mm >= 0.05 && request.edge_mm <= 10))
    throw UsageError("resection: edges must be from 0.05 to 10 mm");
  if (request.range.overlap.leave_out_reference_contacts)
    throw UsageError("resection: contacts of the reference pose cannot be left out of what is removed");
  for (const auto& [kept, body, share] : {std::tuple(&request.mobile, &joint.mobile, 1 - request.fixed_share),
                                          std::tuple(&request.fixed, &joint.fixed, request.fixed_share)})
    if (!kept->vertices.empty() && share == 0)
      throw UsageError("resection: vertices of " + body->name + " are marked to stay, and it is not cut");
  for (const auto& [body, share] :
       {std::pair(&joint.mobile, 1 - request.fixed_share), std::pair(&joint.fixed, request.fixed_share)})
    if (share > 0 && is_cut(*body))
      throw UsageError("resection: a part is cut from " + body->name +
                       ": bone can be taken from the other body only");
  check_kept(request.mobile, joint.mobile);
  check_kept(request.fixed, joint.fixed);
}

ResectionOptions with_gains_resolved(const Joint& joint, const ResectionOptions& request) {
  check_resection(joint, request);
  ResectionOptions resolved = request;
  std::optional<motion::RangeOfMotion> now;
  for (ReachTarget& target : resolved.targets) {
    if (!target.is_gain) continue;
    if (!now) now.emplace(joint, request.range);
    const motion::Limit end = now->limit(target.motion).end;
    const std::string& name = target.motion.name;
    if (end.reason == motion::LimitReason::end_of_range)
      throw MeshError("resection: nothing ends " + name + " within its range of " +
                      degrees(target.motion.range) + " degrees: it has nothing to gain");
    if (end.turned + target.reach > target.motion.range)
      throw UsageError("resection: " + name + " ends at " + degrees(end.turned) + " degrees, and " +
                       degrees(target.reach) + " more are " + degrees(end.turned + target.reach) +
                       ", beyond its range, " + degrees(target.motion.range));
    target = {target.motion, end.turned + target.reach};
  }
  return resolved;
}

Joint with_mobile_mesh(const Joint& joint, Mesh mesh) {
  Joint other = joint;
  // By itself: a head may have been fitted to this mesh already.
  other.mobile.mesh = Mesh(mesh.arrays());
  if (const auto bearing = motion::find_bearing_surface(joint).surface) {
    other.mobile.head = bearing->head;
    other.mobile.bearing_margin_mm = bearing->margin_mm;
    other.fixed.head = bearing->socket;
    kinematics::keep_head(other.mobile.mesh, bearing->head);
  }
  other.mobile.parts.clear();
  other.mobile.image.reset();
  other.posed.reset();
  return other;
}

Resection resect(const Joint& joint, const ResectionOptions& request) {
  return *resect(joint, request, {});
}

std::optional<Resection> resect(const Joint& joint, const ResectionOptions& as_given,
                                const Control& control) {
  const ResectionOptions request = with_gains_resolved(joint, as_given);
  auto done =
      cut_for(joint, request, motion::RangeOfMotion(joint, request.range), CutFacts::all_but_limits, control);
  if (!done) return std::nullopt;
  const motion::RangeOfMotion after(done->joint, request.range);
  for (ReachOutcome& outcome : done->targets) outcome.after = after.limit(outcome.target.motion);
  return done;
}

std::optional<Resection> cut_for(const Joint& joint, const ResectionOptions& request,
                                 const motion::RangeOfMotion& before, CutFacts facts,
                                 const Control& control) {
  Resection done{joint, {}, {}, {}, false};
  std::vector<CutTarget> open;
  for (std::size_t i = 0; i < request.targets.size(); ++i) {
    const ReachTarget& target = request.targets[i];
    done.targets.push_back({target, target.reach, before.limit(target.motion), {}, {}});
    const motion::Limit& end = done.targets.back().before.end;
    if (end.reason == motion::LimitReason::contact_at_start)
      throw MeshError("resection: " + target.motion.name +
                      " is in contact at its start: plan what brings the joint there first, and ask for this "
                      "of the joint without that bone");
    // Whatever bone is taken, the motion goes no farther than its ligaments let it.
    if (const motion::Limit string = motion::ligament_end(joint, target.motion);
        string.ligament && string.turned < target.reach)
      throw MeshError("resection: ligament " + joint.ligaments[*string.ligament].name + " ends " +
                      target.motion.name + " at " + degrees(string.turned) +
                      " degrees: no cut of bone changes that");
    if (end.turned < target.reach || request.margin_mm > 0)
      open.push_back({i, target.motion, target.reach, end.turned});
  }
  const auto note_reach = [&](const BoneCut& cut) {
    for (std::size_t i = 0; i < open.size(); ++i) {
      ReachOutcome& outcome = done.targets[open[i].number];
      outcome.planned = cut.reach()[i];
      outcome.blocked.reset();
      if (cut.stopped()[i]) outcome.blocked = cut.stopped()[i]->by;
    }
  };
  const std::size_t bones = (request.fixed_share < 1) + (request.fixed_share > 0);
  std::size_t cut_bones = 0;
  const auto report = [&] {
    if (control.progress) control.progress("bones", cut_bones++, bones);
    return !control.stop.stop_requested();
  };
  if (!report()) return std::nullopt;
  if (request.fixed_share < 1 && !open.empty()) {
    BoneCut cut(joint, BodyRole::mobile, request, open, 1 - request.fixed_share);
    note_reach(cut);
    done.sweeps_bearing = facts != CutFacts::curve && cut.sweeps_bearing();
    if (cut.removes_any() || cut.reaches_by_smaller_triangles()) {
      done.mobile = cut.cut_bone(facts);
      done.joint = cut.joint();
    }
    if (!report()) return std::nullopt;
  }
  if (request.fixed_share > 0 && !open.empty()) {
    const Joint with_mobile = done.joint;
    BoneCut cut(with_mobile, BodyRole::fixed, request, open, 1);
    note_reach(cut);
    if (cut.removes_any() || cut.reaches_by_smaller_triangles()) {
      done.fixed = cut.cut_bone(facts);
      done.joint = cut.joint();
    }
    if (!report()) return std::nullopt;
  }
  kinematics::take_as_moved(done.joint);
  if (done.mobile || done.fixed) {
    if (!done.joint.name.ends_with(resected)) done.joint.name += resected;
    for (const auto* cut : {&done.mobile, &done.fixed})
      if (*cut) add_planned(done.joint, without_bone((*cut)->volume_mm3, (*cut)->body.name));
  }
  return done;
}

}  // namespace condyle::plan
