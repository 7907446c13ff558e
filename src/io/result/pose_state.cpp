#include "io/result/pose_state.hpp"

#include <fmt/format.h>

#include <cmath>

#include "io/result/movement_words.hpp"

namespace condyle::io {

std::string state_words(const PoseStanding& standing, Anatomy joint) {
  switch (standing.state) {
    case PoseState::free:
      return "free";
    case PoseState::at_limit:
      return "at the limit of " + movement_words(standing.nearest->vary, standing.nearest->sense, joint);
    case PoseState::bearing:
      return "bearing contact, ends no motion";
    case PoseState::impinging:
      return "in contact: impinging";
    case PoseState::strained:
      return "past the end of a ligament";
    case PoseState::contact:
      break;
  }
  return "in contact, and any contact ends a motion";
}

std::string state_text(const PoseStanding& standing, Anatomy joint) {
  const std::string words = state_words(standing, joint);
  if (standing.state != PoseState::contact) return words;
  return words + ": " + (standing.why_unknown.empty() ? "no bearing surface is known" : standing.why_unknown);
}

std::string to_limit_text(const PoseStanding& standing, Anatomy joint) {
  if (!standing.nearest || standing.state == PoseState::at_limit) return "";
  return fmt::format("{:.1f} degrees of {} to the nearest limit", standing.to_limit_deg(),
                     movement_words(standing.nearest->vary, standing.nearest->sense, joint));
}

void add_standing(Json& json, const std::optional<PoseStanding>& standing, Anatomy joint) {
  json["state"] = standing ? Json(name_of(standing->state)) : Json(nullptr);
  json["state_unknown_why"] =
      standing && !standing->why_unknown.empty() ? Json(standing->why_unknown) : Json(nullptr);
  json["nearest_limit"] = nullptr;
  if (standing && standing->nearest)
    json["nearest_limit"] = {
        {"movement", movement_name(standing->nearest->vary, standing->nearest->sense, joint)},
        {"to_limit_deg", standing->to_limit_deg()},
        {"reason", motion::name_of(standing->nearest->end.reason)}};
  json["clearance_mm"] =
      standing && std::isfinite(standing->clearance_mm) ? Json(standing->clearance_mm) : Json(nullptr);
}

}  // namespace condyle::io
