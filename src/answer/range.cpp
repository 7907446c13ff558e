#include <algorithm>

#include "answer/closed_limits.hpp"
#include "answer/exact_limits.hpp"
#include "answer/followed_range.hpp"
#include "condyle/answer.hpp"
#include "condyle/error.hpp"
#include "core/formatted.hpp"

namespace condyle {
namespace {

void add_depth_limits(RangeAnswer& answer, const RangeRequest& request) {
  const motion::DepthRange range(answer.joint, *request.allowed_depth);
  answer.depths = range.limits(request.motions);
  answer.bearing = range.bearing();
  answer.clock = answer::clock_of(answer.joint, request.clock, answer.bearing);
  for (const motion::DepthLimit& depth : answer.depths) answer.limits.push_back(depth.limit);
  answer.caveats.push_back(
      core::formatted("allowed: a radial depth of %g mm; limits are searched for, not exact",
                      request.allowed_depth->depth_mm));
  if (answer.bearing.roles.has(motion::ContactRole::soft))
    answer.caveats.emplace_back("allowed: depths include all meshes, soft ones too");
}

/// Which axes of a map end before what was asked for.
void note_axes(const motion::MapGrid& grid, Anatomy anatomy, std::vector<RangeNote>& notes) {
  for (const motion::GridAxis* axis : {&grid.column, &grid.row})
    if (axis->ends_early())
      notes.push_back(
          {RangeNoteCode::last_value_left_out,
           core::formatted(
               "the map goes up to %s %.10g, not %.10g: the step of %.10g %s leads to no point there",
               std::string(name_of(axis->coordinate, anatomy)).c_str(), axis->value(axis->count() - 1),
               axis->last, axis->step, axis->coordinate.is_angle() ? "degrees" : "mm")});
}

bool has_ends_by_ligaments(const Joint& joint) {
  return std::any_of(joint.ligaments.begin(), joint.ligaments.end(),
                     [](const Ligament& ligament) { return ligament.ends_at_strain.has_value(); });
}

/// What holds a joint together that a map translates.
void note_translations(const motion::MapGrid& grid, const Joint& joint, std::vector<RangeNote>& notes) {
  if (!grid.translates()) return;
  std::string text =
      "the map takes the joint to translations at which no surfaces meet, and in this model nothing else "
      "holds "
      "it together: no capsule, no muscle, no ";
  text += has_ends_by_ligaments(joint) ? "ligament but those of the joint file" : "ligament";
  notes.push_back({RangeNoteCode::nothing_holds_joint, std::move(text)});
}

/// Zones, map and bands, as far as they are requested; false if stopped.
bool add_beyond_limits(RangeAnswer& answer, const RangeRequest& request, const motion::RangeOptions& again,
                       const Control& control) {
  if (request.zones_past) {
    const motion::ZoneFinder finder(
        answer.joint, {.bearing = again.bearing, .past = *request.zones_past, .socket_clock = answer.clock});
    for (const motion::MotionLimit& limit : answer.limits) {
      if (control.stop.stop_requested()) return false;
      answer.zones.push_back(finder.zone(limit));
      if (control.progress) control.progress("zones", answer.zones.size(), answer.limits.size());
    }
  }
  if (request.map) {
    motion::MapGrid grid = *request.map;
    grid.held.translation_mm = answer.held_translation_mm.value_or(Vec3::Zero());
    answer.map = motion::motion_map(grid, *answer.range, control);
    if (!answer.map) return false;
    note_axes(grid, answer.joint.anatomy, answer.notes);
    note_translations(grid, answer.joint, answer.notes);
  }
  if (request.bands) {
    auto bands = motion::limit_bands(answer.joint, request.motions, again, answer.band_options, control);
    if (!bands) return false;
    answer.bands = std::move(*bands);
    const motion::Uncertainty& sigma = answer.band_options.sigma;
    if (sigma.surface_from.empty() &&
        (sigma.is_by_voxels(answer.joint.fixed) || sigma.is_by_voxels(answer.joint.mobile)))
      answer.caveats.push_back(
          core::formatted("the band takes %g voxels along the normal as the standard deviation of surfaces "
                          "from label maps: the grid's part, not the error of the segmentation",
                          sigma.surface_voxels));
  }
  return true;
}

}  // namespace

void check_map(const motion::MapGrid& grid, const Joint& joint) {
  motion::check_grid(grid, joint.kind);
  if (!grid.vary.is_angle() && has_ends_by_ligaments(joint))
    throw UsageError(
        "map: ligaments end motions of this joint, and how far they let it translate is not computed: "
        "vary an angle, or leave their ends out of the joint file");
}

void check_range_request(const Case& of, const RangeRequest& request) {
  const Joint& joint = of.joint;
  if (!request.follow) (void)held_translation(of, request.translation_mm);
  for (const motion::Motion& motion : request.motions) motion::check_motion(motion, joint.kind);
  if (request.map) check_map(*request.map, joint);
  if (request.allowed_depth && (request.map || request.bands || request.zones_past))
    throw UsageError("an allowed depth gives limits only: no map, bands or zones");
  if (!request.follow) return;
  if (joint.kind != JointKind::free)
    throw UsageError("only the translation of a free joint follows anything");
  if (request.allowed_depth || request.map || request.bands || request.zones_past)
    throw UsageError(
        "a translation that follows a recorded motion or a load gives limits only: no map, bands, zones or "
        "allowed depth");
  if (request.translation_mm) throw UsageError("translation: either held or following: one of the two");
  if (request.range.overlap.leave_out_reference_contacts)
    throw UsageError("a translation that follows: no contacts are left out");
  answer::check_follow(request);
}

std::optional<RangeAnswer> answer_range(const Case& of, const RangeRequest& request, const Control& control) {
  check_range_request(of, request);
  if (request.follow) return answer::followed_range(of, request, control);
  const auto beyond = [&](RangeAnswer& answer, const motion::RangeOptions& again) {
    return add_beyond_limits(answer, request, again, control);
  };
  return answer::held_answer(of, request, [&](RangeAnswer& answer, const motion::RangeOptions& options) {
    if (!request.allowed_depth)
      return answer::add_exact_limits(answer, request, options, control.stop, beyond);
    add_depth_limits(answer, request);
    return true;
  });
}

std::optional<RangeAnswer> further_answer(const Case& of, const RangeAnswer& kept,
                                          const RangeRequest& request, const Control& control) {
  for (const motion::Motion& motion : request.motions) motion::check_motion(motion, of.joint.kind);
  if (request.map) check_map(*request.map, of.joint);
  RangeAnswer answer{.joint = kept.joint,
                     .held_translation_mm = kept.held_translation_mm,
                     .bearing = kept.bearing,
                     .bearing_rule = kept.bearing_rule,
                     .clock = kept.clock,
                     .clock_plane = kept.clock_plane,
                     .caveats = kept.caveats,
                     .range = kept.range};
  if (!answer::add_limits(answer, request.motions, control.stop)) return std::nullopt;
  answer::add_closed_limits(answer);
  answer.notes.clear();
  if (request.bands) answer.band_options = band_options(of, *request.bands);
  motion::RangeOptions again = request.range;
  again.overlap.reference_pose = of.placement.reference_pose.angles;
  again.bearing.surface = answer.bearing.surface;
  if (!add_beyond_limits(answer, request, again, control)) return std::nullopt;
  return answer;
}

RangeAnswer answer_range(const Case& joint, const RangeRequest& request) {
  return *answer_range(joint, request, {});
}

}  // namespace condyle
