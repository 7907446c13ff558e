#include <algorithm>

#include "answer/closed_limits.hpp"
#include "answer/followed_range.hpp"
#include "answer/staged.hpp"
#include "condyle/answer.hpp"
#include "condyle/error.hpp"
#include "condyle/joint.hpp"
#include "core/formatted.hpp"

namespace condyle {
namespace {

/// Motions between two looks whether to stop: some ten milliseconds.
constexpr std::size_t motions_at_once = 16;

/// The limits of all motions; fewer if stopped.
std::vector<motion::MotionLimit> limits_of(const motion::RangeOfMotion& range,
                                           std::span<const motion::Motion> motions,
                                           const std::stop_token& stop) {
  std::vector<motion::MotionLimit> limits;
  while (limits.size() < motions.size() && !stop.stop_requested()) {
    const auto next =
        motions.subspan(limits.size(), std::min(motions_at_once, motions.size() - limits.size()));
    for (motion::MotionLimit& limit : range.limits(next)) limits.push_back(std::move(limit));
  }
  return limits;
}

motion::ClockFace clock_of(const Joint& joint, motion::ClockPlane plane,
                           const motion::BearingFinding& bearing) {
  if (plane == motion::ClockPlane::sagittal) return motion::sagittal_clock();
  const auto clock = bearing.surface && joint.is_hip()
                         ? motion::find_rim_clock(joint.fixed.mesh, bearing.surface->head)
                         : std::nullopt;
  if (!clock)
    throw MeshError(joint.fixed.name + ": no rim with a notch was found: there is only the sagittal clock");
  return *clock;
}

void add_depth_limits(RangeAnswer& answer, const RangeRequest& request) {
  const motion::DepthRange range(answer.joint, *request.allowed_depth);
  answer.depths = range.limits(request.motions);
  answer.bearing = range.bearing();
  answer.clock = clock_of(answer.joint, request.clock, answer.bearing);
  for (const motion::DepthLimit& depth : answer.depths) answer.limits.push_back(depth.limit);
  answer.caveats.push_back(
      core::formatted("allowed: a radial depth of %g mm; limits are searched for, not exact",
                      request.allowed_depth->depth_mm));
  if (answer.bearing.roles.has(motion::ContactRole::soft))
    answer.caveats.emplace_back("allowed: depths include all meshes, soft ones too");
}

/// False if stopped.
bool add_exact_limits(RangeAnswer& answer, const RangeRequest& request, const motion::RangeOptions& options,
                      const AnswerControl& control) {
  const motion::RangeOfMotion range(answer.joint, options);
  answer.bearing = range.bearing();
  answer.bearing_rule = range.bearing_rule();
  answer.clock = clock_of(answer.joint, request.clock, answer.bearing);
  answer.caveats = range_caveats(options, range);
  answer.limits = limits_of(range, request.motions, control.stop);
  if (answer.limits.size() < request.motions.size()) return false;

  motion::RangeOptions again = options;
  again.bearing.surface = answer.bearing.surface;
  answer.notes = range_notes(answer.joint, answer.limits, again, answer.bearing);
  answer::add_closed_limits(answer);
  if (request.zones_past) {
    const motion::ZoneFinder finder(
        answer.joint, {.bearing = again.bearing, .past = *request.zones_past, .socket_clock = answer.clock});
    for (const motion::MotionLimit& limit : answer.limits) answer.zones.push_back(finder.zone(limit));
  }
  if (request.map) {
    answer.map = motion::motion_map(*request.map, range, answer::staged(control, "map points"));
    if (!answer.map) return false;
  }
  if (request.bands) {
    auto bands = motion::limit_bands(answer.joint, request.motions, again, *request.bands,
                                     answer::staged(control, "joints of the band"));
    if (!bands) return false;
    answer.bands = std::move(*bands);
    const motion::Uncertainty& sigma = request.bands->sigma;
    if (sigma.is_by_voxels(answer.joint.fixed) || sigma.is_by_voxels(answer.joint.mobile))
      answer.caveats.push_back(core::formatted(
          "the band takes %g voxels along the normal as the standard deviation of surfaces from label "
          "maps: the grid's part, not the error of the segmentation",
          sigma.surface_voxels));
  }
  return true;
}

}  // namespace

std::optional<Vec3> held_translation(const Joint& joint, const JointPlacement& placement,
                                     const std::optional<Vec3>& requested) {
  if (joint.kind != JointKind::free) {
    if (requested) throw UsageError("translation: only a free joint translates");
    return std::nullopt;
  }
  const Vec3 held = requested.value_or(placement.reference_pose.translation_mm);
  if (joint.translation_frame == TranslationFrame::joint_axes && held != Vec3::Zero())
    throw UsageError(
        "translation: held along the joint's axes it would turn with them: motions need zero or "
        "translation_frame = \"fixed\"");
  return held;
}

void check_range_request(const Joint& joint, const JointPlacement& placement, const RangeRequest& request) {
  if (!request.follow) held_translation(joint, placement, request.translation_mm);
  for (const motion::Motion& motion : request.motions) motion::check_motion(motion, joint.kind);
  if (request.map) motion::check_grid(*request.map, joint.kind);
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

std::vector<std::string> range_caveats(const motion::RangeOptions& options,
                                       const motion::RangeOfMotion& range) {
  std::vector<std::string> caveats;
  const motion::OverlapOptions& overlap = options.overlap;
  if (overlap.leave_out_reference_contacts)
    caveats.push_back(
        core::formatted("left out: triangles in contact in the reference pose and %d rings of neighbours, "
                        "%zu of the fixed body and %zu of the mobile one",
                        overlap.leave_out_reference_contacts->rings, range.left_out().fixed_triangles,
                        range.left_out().mobile_triangles));
  if (overlap.reference_contact == motion::ReferenceContact::accept)
    caveats.emplace_back(
        "contact in the reference pose is accepted: motions that start in contact are reported as such");
  return caveats;
}

std::optional<RangeAnswer> answer_range(const Joint& joint, const JointPlacement& placement,
                                        const RangeRequest& request, const AnswerControl& control) {
  check_range_request(joint, placement, request);
  const std::optional<Vec3> held = held_translation(joint, placement, request.translation_mm);
  if (request.follow) return answer::followed_range(joint, placement, request, control);
  RangeAnswer answer{.joint = held_at(joint, held.value_or(Vec3::Zero())), .held_translation_mm = held};
  answer.clock_plane = request.clock;
  if (request.bands) answer.band_options = *request.bands;
  motion::RangeOptions options = request.range;
  options.overlap.reference_pose = placement.reference_pose.angles;

  if (request.allowed_depth)
    add_depth_limits(answer, request);
  else if (!add_exact_limits(answer, request, options, control))
    return std::nullopt;
  if (held)
    answer.caveats.push_back(
        core::formatted("translation held at x %g, y %g, z %g mm: the mobile body turns about its own origin",
                        held->x() + 0.0, held->y() + 0.0, held->z() + 0.0));
  return answer;
}

RangeAnswer answer_range(const Joint& joint, const JointPlacement& placement, const RangeRequest& request) {
  return *answer_range(joint, placement, request, {});
}

}  // namespace condyle
