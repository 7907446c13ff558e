#include "condyle/io/motion_result.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "condyle/io/pose_text.hpp"
#include "io/file/format_version.hpp"
#include "io/result/contact_terms.hpp"
#include "io/result/json.hpp"
#include "io/result/provenance_forms.hpp"

namespace condyle {
namespace {

using io::Json;

/// What a person wants to know of a motion before looking at its curves.
struct Summary {
  std::size_t frames = 0, gaps = 0, in_contact = 0, balanced = 0, from_front = 0;
  struct Largest {
    double value = 0, at = 0;
  };
  Largest area, depth, pressure, force;
};

Summary summary_of(const MotionQuestion& question, const MotionAnswer& answer) {
  Summary summary;
  summary.frames = answer.frames.size();
  for (std::size_t i = 0; i < answer.frames.size(); ++i) {
    const auto& frame = answer.frames[i];
    if (!question.motion.X_FM[i]) ++summary.gaps;
    if (!answer.balanced.empty() && answer.balanced[i] &&
        answer.balanced[i]->outcome == BalanceOutcome::balanced)
      ++summary.balanced;
    if (!frame) continue;
    if (frame->in_contact) ++summary.in_contact;
    if (frame->surface.met_from_front > 0) ++summary.from_front;
    const ContactTotals& totals = frame->surface.totals;
    const auto consider = [&](Summary::Largest& largest, double value) {
      if (value > largest.value) largest = {value, question.motion.times.values[i]};
    };
    consider(summary.area, totals.area_mm2);
    consider(summary.depth, totals.max_depth_mm);
    consider(summary.pressure, totals.max_pressure_mpa);
    consider(summary.force, totals.force_n.norm());
  }
  return summary;
}

}  // namespace

std::string motion_text(const MotionQuestion& question, const MotionAnswer& answer) {
  const Summary summary = summary_of(question, answer);
  const Joint& joint = question.joint.joint;
  const FrameTimes& times = question.motion.times;
  const char* unit = times.in_seconds ? " s" : "";
  std::string text =
      fmt::format("{}: {} frames, {}{:g} to {:g}{}\n", joint.name, summary.frames,
                  times.in_seconds ? "" : "numbers ", times.values.front(), times.values.back(), unit);
  if (summary.gaps > 0) text += fmt::format("  {} frames are gaps: no answer there\n", summary.gaps);
  text += io::contact_terms_text(question.contact, question.surfaces, question.with_pressure);
  text += fmt::format("  {} frames in contact\n", summary.in_contact);
  const auto line = [&](const char* what, const Summary::Largest& largest, const char* of) {
    if (largest.value > 0)
      text += fmt::format("  largest {} {:.4g} {} at {:g}{}\n", what, largest.value, of, largest.at, unit);
  };
  line("contact area", summary.area, "mm2");
  line("depth", summary.depth, "mm");
  if (question.with_pressure) {
    line("pressure", summary.pressure, "MPa");
    line("force", summary.force, "N");
  }
  if (!answer.balanced.empty()) {
    text += fmt::format("  the load is balanced in {} of {} frames\n", summary.balanced,
                        summary.frames - summary.gaps);
    for (std::size_t i = 0, said = 0; i < answer.balanced.size() && said < 3; ++i)
      if (answer.balanced[i] && answer.balanced[i]->outcome != BalanceOutcome::balanced)
        text += fmt::format("  {:g}{}: {}\n", times.values[i], unit, reason_of(*answer.balanced[i])), ++said;
  }
  if (summary.from_front > 0)
    text += fmt::format("  in {} frames rays met the open target from its front: overlap there may be none\n",
                        summary.from_front);
  return text;
}

std::string motion_json(const MotionQuestion& question, const MotionAnswer& answer) {
  const Summary summary = summary_of(question, answer);
  const Joint& joint = question.joint.joint;
  const FrameTimes& times = question.motion.times;
  const char* axis = times.in_seconds ? "time_s" : "frame";
  const auto largest = [&](const Summary::Largest& of) { return Json{{"value", of.value}, {axis, of.at}}; };
  Json json{{"condyle", io::format_version},
            {"joint", joint.name},
            {"fixed", question.surfaces.fixed.name},
            {"mobile", question.surfaces.mobile.name},
            {"anatomy", io::anatomy_json(joint)},
            {"side", name_of(joint.side)},
            {"contact", io::contact_terms(question.contact, question.with_pressure)},
            {"frames", summary.frames},
            {"gaps", summary.gaps},
            {"first", times.values.front()},
            {"last", times.values.back()},
            {"along", axis},
            {"frames_in_contact", summary.in_contact},
            {"frames_met_from_front", summary.from_front},
            {"largest_area_mm2", largest(summary.area)},
            {"largest_depth_mm", largest(summary.depth)}};
  if (question.with_pressure) {
    json["largest_pressure_mpa"] = largest(summary.pressure);
    json["largest_force_n"] = largest(summary.force);
    json["terms"] = io::foundation_note;
  }
  if (!answer.balanced.empty()) {
    json["frames_balanced"] = summary.balanced;
    Json without = Json::array();
    for (std::size_t i = 0; i < answer.balanced.size(); ++i)
      if (answer.balanced[i] && answer.balanced[i]->outcome != BalanceOutcome::balanced)
        without.push_back({{axis, times.values[i]},
                           {"outcome", io::name_of(answer.balanced[i]->outcome)},
                           {"reason", reason_of(*answer.balanced[i])}});
    json["without_balance"] = without;
  }
  json["done"] = question.motion.notes;
  json["notes"] = io::notes_json(question.notes);
  json["scope"] = io::scope_note;
  json["provenance"] = io::provenance_json(question.provenance);
  return io::document(std::move(json));
}

}  // namespace condyle
