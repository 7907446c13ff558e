#include "io/result/rom_result.hpp"

#include <fmt/format.h>

#include "io/result/rom_parts.hpp"

namespace condyle::io {
std::string_view name_of(motion::FeatureKind kind) noexcept {
  switch (kind) {
    case motion::FeatureKind::vertex:
      return "vertex";
    case motion::FeatureKind::edge:
      return "edge";
    case motion::FeatureKind::face:
      return "face";
  }
  return "vertex";
}

const BodyPart* part_of(const Body& body, const motion::Feature& feature) noexcept {
  return feature.kind == motion::FeatureKind::face ? part_of_triangle(body, feature.id)
                                                   : part_of_vertex(body, feature.id);
}

std::string text_of(const motion::Feature& feature) {
  return feature.kind == motion::FeatureKind::edge ? fmt::format("edge {}-{}", feature.id, feature.other_end)
                                                   : fmt::format("{} {}", name_of(feature.kind), feature.id);
}

std::string guarantee_text(const motion::MotionLimit& limit) {
  const bool is_bounded = limit.translation_mm && limit.end.reason == motion::LimitReason::contact;
  if (is_bounded)
    return fmt::format(
        "bounded, not exact: free up to the limit; past it by {:.2g} deg in contact, or nearer to it than "
        "some "
        "micrometres",
        limit.end.error_bound.degrees());
  if (limit.translation_ends && !limit.translation_mm)
    return "none: no contact carries the load at the start";
  if (limit.translation_ends)
    return fmt::format("free over {:g} deg, as far as what the translation follows goes; unknown past it",
                       limit.end.turned.degrees());
  switch (limit.end.reason) {
    case motion::LimitReason::contact:
      return fmt::format("free before the limit; in contact at it or past it by at most {:.2g} deg",
                         limit.end.error_bound.degrees());
    case motion::LimitReason::end_of_range:
      return fmt::format("free over the whole range of {:g} deg", limit.motion.range.degrees());
    case motion::LimitReason::contact_at_start:
      return "in contact before any rotation";
  }
  return "";
}

std::string guarantee_text(const motion::DepthLimit& depth) {
  switch (depth.limit.end.reason) {
    case motion::LimitReason::contact:
      return fmt::format(
          "searched, not exact: no deeper than allowed at the poses tried before the limit, deeper within "
          "{:.2g} deg past it{}",
          depth.limit.end.error_bound.degrees(),
          depth.depth_grows ? "" : "; depth does not grow evenly here, a little further on may be as good");
    case motion::LimitReason::end_of_range:
      return fmt::format(
          "searched, not exact: no deeper than allowed at the poses tried over the range of {:g} deg",
          depth.limit.motion.range.degrees());
    case motion::LimitReason::contact_at_start:
      return "deeper than allowed before any rotation";
  }
  return "";
}

RomResult rom_result_of(const RangeAnswer& answer, std::span<const JointNote> notes, Provenance* from) {
  if (from && answer.held_translation_mm) from->frame = from->frame.of_held(*answer.held_translation_mm);
  return {answer.joint, answer, notes, from};
}

AnswerFrame frame_of(const RomResult& result) {
  if (result.provenance) return result.provenance->frame;
  return AnswerFrame{}.of_held(result.answer.held_translation_mm.value_or(Vec3::Zero()));
}

}  // namespace condyle::io
