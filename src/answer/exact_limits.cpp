#include "answer/exact_limits.hpp"

#include <algorithm>
#include <cstddef>

#include "answer/closed_limits.hpp"
#include "condyle/error.hpp"
#include "core/formatted.hpp"

namespace condyle {
namespace {

/// Motions between two looks whether to stop: some ten milliseconds.
constexpr std::size_t motions_at_once = 16;

}  // namespace

std::optional<Vec3> held_translation(const Case& of, const std::optional<Vec3>& requested) {
  const Joint& joint = of.joint;
  if (joint.kind != JointKind::free) {
    if (requested) throw UsageError("translation: only a free joint translates");
    return std::nullopt;
  }
  const Vec3 held = requested.value_or(of.placement.reference_pose.translation_mm);
  if (joint.translation_frame == TranslationFrame::joint_axes && held != Vec3::Zero())
    throw UsageError(
        "translation: held along the joint's axes it would turn with them: motions need zero or "
        "translation_frame = \"fixed\"");
  return held;
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

namespace answer {

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

bool add_limits(RangeAnswer& answer, std::span<const motion::Motion> motions, const std::stop_token& stop) {
  std::vector<motion::MotionLimit>& limits = answer.limits;
  while (limits.size() < motions.size()) {
    if (stop.stop_requested()) return false;
    const auto next =
        motions.subspan(limits.size(), std::min(motions_at_once, motions.size() - limits.size()));
    for (motion::MotionLimit& limit : answer.range->limits(next)) limits.push_back(std::move(limit));
  }
  return true;
}

std::optional<RangeAnswer> held_answer(const Case& of, const RangeRequest& request, const AddLimits& add) {
  const std::optional<Vec3> held = held_translation(of, request.translation_mm);
  RangeAnswer answer{.joint = held_at(of.joint, held.value_or(Vec3::Zero())), .held_translation_mm = held};
  answer.clock_plane = request.clock;
  if (request.bands) answer.band_options = band_options(of, *request.bands);
  motion::RangeOptions options = request.range;
  options.overlap.reference_pose = of.placement.reference_pose.angles;
  if (!add(answer, options)) return std::nullopt;
  if (held)
    answer.caveats.push_back(
        core::formatted("translation held at x %g, y %g, z %g mm: the mobile body turns about its own origin",
                        held->x() + 0.0, held->y() + 0.0, held->z() + 0.0));
  return answer;
}

bool add_exact_limits(RangeAnswer& answer, const RangeRequest& request, const motion::RangeOptions& options,
                      const std::stop_token& stop, const AddBeyondLimits& beyond) {
  answer.range = std::make_shared<const motion::RangeOfMotion>(answer.joint, options);
  answer.bearing = answer.range->bearing();
  answer.bearing_rule = answer.range->bearing_rule();
  answer.clock = clock_of(answer.joint, request.clock, answer.bearing);
  answer.caveats = range_caveats(options, *answer.range);
  if (!add_limits(answer, request.motions, stop)) return false;

  motion::RangeOptions again = options;
  again.bearing.surface = answer.bearing.surface;
  answer.notes = range_notes(answer.joint, answer.limits, again, answer.bearing);
  add_closed_limits(answer);
  return !beyond || beyond(answer, again);
}

RangeAnswer exact_limits(const Case& of, const RangeRequest& request) {
  const auto add = [&](RangeAnswer& answer, const motion::RangeOptions& options) {
    return add_exact_limits(answer, request, options, {});
  };
  return *held_answer(of, request, add);
}

}  // namespace answer
}  // namespace condyle
