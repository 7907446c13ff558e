#include "answer/limit_facts.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include "condyle/joint_checks.hpp"
#include "condyle/resection.hpp"
#include "core/formatted.hpp"
#include "core/rounded.hpp"
#include "motion/rom/socket_hour.hpp"

namespace condyle {

const BodyPart* part_of(const Body& body, const motion::Feature& feature) noexcept {
  return feature.kind == motion::FeatureKind::face ? part_of_triangle(body, feature.id)
                                                   : part_of_vertex(body, feature.id);
}

std::optional<Angle> normal_hip_range(std::string_view motion) noexcept {
  struct Range {
    std::string_view motion;
    double degrees;
  };
  static constexpr std::array ranges{Range{"flexion", 120},          Range{"extension", 30},
                                     Range{"abduction", 45},         Range{"adduction", 30},
                                     Range{"internal_rotation", 45}, Range{"external_rotation", 45}};
  for (const Range& range : ranges)
    if (range.motion == motion) return Angle::degrees(range.degrees);
  return std::nullopt;
}

std::optional<Angle> normal_range(const Joint& joint, const motion::MotionLimit& limit) {
  if (!joint.is_hip() || !joint.person.is_human() || !zero_pose(joint).is_neutral()) return std::nullopt;
  return normal_hip_range(limit.motion.name);
}

std::optional<BoneReference> bone_reference(const Joint& joint, const motion::MotionLimit& limit) {
  static constexpr std::array references{
      BoneReference{"internal_rotation_at_90_flexion", Angle::degrees(27.9), Angle::degrees(21.1),
                    Angle::degrees(12.3), 10, "Audenaert 2012, doi 10.1177/0363546512441328"}};
  const motion::Motion& motion = limit.motion;
  const auto known = std::find_if(references.begin(), references.end(),
                                  [&](const BoneReference& each) { return each.motion == motion.name; });
  if (known == references.end() || !joint.is_hip() || !joint.person.is_human() || joint.implant ||
      !zero_pose(joint).is_neutral())
    return std::nullopt;
  // A motion of one's own may have a built-in one's name and be another.
  const std::vector<motion::Motion> built_in = motion::hip_motions();
  const motion::Motion& same = motion::motion_named(built_in, known->motion);
  if (same.vary != motion.vary || same.sense != motion.sense || same.start != motion.start)
    return std::nullopt;
  if (limit.end.ligament) return std::nullopt;
  if (ends_in_contact(limit) && limit.end.kind() != motion::ContactKind::impingement) return std::nullopt;
  return *known;
}

bool is_short(const BoneReference& reference, const motion::MotionLimit& limit) noexcept {
  return ends_in_contact(limit) && limit.end.turned <= reference.cam_without_complaints;
}

std::optional<double> clock_hour(const RangeAnswer& answer, const motion::MotionLimit& limit) {
  if (!answer.joint.is_hip() || !limit.end.contact) return std::nullopt;
  return motion::socket_hour(answer.clock, answer.bearing.surface, limit.end.contact->fixed_point);
}

double degrees_turned(Angle turned, const motion::Motion& motion) noexcept {
  return turned == motion.range ? plan::asked_degrees(turned) : turned.degrees();
}

std::string quoted_band(const motion::LimitBand& band, const motion::Motion& motion) {
  const auto end = [&](Angle turned) {
    return (turned < motion.range ? "" : ">") + core::formatted("%.0f", turned.degrees());
  };
  const std::string low = end(band.p5), high = end(band.p95);
  return low == high || ">" + low == high ? high : low + "\xE2\x80\x93" + high;
}

std::string guarantee_text(const motion::MotionLimit& limit) {
  const bool is_bounded = limit.translation_mm && limit.end.reason == motion::LimitReason::contact;
  const std::string error_bound_deg = core::at_most(limit.end.error_bound.degrees(), 2);
  if (is_bounded)
    return core::formatted(
        "bounded, not exact: free up to the limit; past it by %s deg in contact, or nearer to it than some "
        "micrometres",
        error_bound_deg.c_str());
  if (limit.translation_ends && !limit.translation_mm)
    return "none: no contact carries the load at the start";
  if (limit.translation_ends)
    return core::formatted("free over %g deg, as far as what the translation follows goes; unknown past it",
                           limit.end.turned.degrees());
  switch (limit.end.reason) {
    case motion::LimitReason::contact:
      return core::formatted("free before the limit; in contact at it or past it by at most %s deg",
                             error_bound_deg.c_str());
    case motion::LimitReason::end_of_range:
      return core::formatted("free over the whole range of %g deg", limit.motion.range.degrees());
    case motion::LimitReason::contact_at_start:
      return "in contact before any rotation";
    case motion::LimitReason::ligament:
      return core::formatted(
          "free and no ligament strained beyond its end before the limit; one is at it or past it by at most "
          "%s deg",
          error_bound_deg.c_str());
    case motion::LimitReason::strained_at_start:
      return "a ligament is strained beyond its end before any rotation";
  }
  return "";
}

std::string guarantee_text(const motion::DepthLimit& depth) {
  switch (depth.limit.end.reason) {
    case motion::LimitReason::contact:
      return core::formatted(
          "searched, not exact: no deeper than allowed at the poses tried before the limit, deeper within "
          "%.2g deg past it%s",
          depth.limit.end.error_bound.degrees(),
          depth.depth_grows ? "" : "; depth does not grow evenly here, a little further on may be as good");
    case motion::LimitReason::end_of_range:
      return core::formatted(
          "searched, not exact: no deeper than allowed at the poses tried over the range of %g deg",
          depth.limit.motion.range.degrees());
    case motion::LimitReason::contact_at_start:
      return "deeper than allowed before any rotation";
    case motion::LimitReason::ligament:
    case motion::LimitReason::strained_at_start:
      break;
  }
  return "";
}

}  // namespace condyle
