#include "io/result/motion_result.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "condyle/io/pose_text.hpp"
#include "core/counted.hpp"
#include "core/rounded.hpp"
#include "io/file/format_version.hpp"
#include "io/result/contact_terms.hpp"
#include "io/result/json.hpp"
#include "io/result/movement_words.hpp"
#include "io/result/parameters.hpp"
#include "io/result/provenance_forms.hpp"
#include "io/result/rom_parts.hpp"
#include "io/result/scope_text.hpp"

namespace condyle::io {
namespace {

using io::Json;

/// Summary of a motion, to read before its curves.
struct Summary {
  std::size_t frames = 0, gaps = 0, in_contact = 0, balanced = 0, carried = 0, from_front = 0, cut_off = 0,
              oblique = 0, oblique_peak = 0;
  struct Largest {
    double value = 0, at = 0;
    const motion::FrameContact* frame = nullptr;  ///< none if no frame has a value
  };
  Largest area, depth, pressure, force;
  std::size_t screws = 0, slides = 0;  ///< steps with and without an axis
  Largest screw_deg, screw_mm;
  Largest nearest;  ///< the smallest gap
  /// How many judged frames are in each state, and which have the least clearance and are nearest to a limit.
  std::array<std::size_t, 6> states{};
  std::optional<std::size_t> tightest = {}, nearest_limit = {};
  std::string state_unknown_why = {};

  void judge(const PoseStanding& at, const std::vector<std::optional<PoseStanding>>& all, std::size_t i) {
    ++states[static_cast<std::size_t>(at.state)];
    if (!at.why_unknown.empty()) state_unknown_why = at.why_unknown;
    if (!tightest || at.clearance_mm < all[*tightest]->clearance_mm) tightest = i;
    const double left = at.to_limit_deg();
    if (!std::isnan(left) && (!nearest_limit || left < all[*nearest_limit]->to_limit_deg()))
      nearest_limit = i;
  }
  std::size_t count(PoseState state) const { return states[static_cast<std::size_t>(state)]; }
};

Summary summary_of(const MotionQuestion& question, const MotionAnswer& answer) {
  Summary summary;
  summary.frames = answer.frames.size();
  for (std::size_t i = 0; i < answer.frames.size(); ++i) {
    const auto& frame = answer.frames[i];
    if (!question.motion.X_FM[i]) ++summary.gaps;
    if (!answer.balanced.empty() && answer.balanced[i]) {
      if (answer.balanced[i]->outcome == contact::BalanceOutcome::balanced) ++summary.balanced;
      if (answer.balanced[i]->carries_load()) ++summary.carried;
    }
    if (!frame) continue;
    if (!answer.standings.empty()) summary.judge(*answer.standings[i], answer.standings, i);
    if (frame->in_contact) ++summary.in_contact;
    if (frame->surface.met_from_front > 0) ++summary.from_front;
    if (frame->cut_off_by_reach > 0) ++summary.cut_off;
    if (frame->surface.oblique_area_mm2 > 0) ++summary.oblique;
    if (frame->surface.peak_is_oblique) ++summary.oblique_peak;
    const contact::ContactTotals& totals = frame->surface.totals;
    const auto consider = [&](Summary::Largest& largest, double value) {
      if (value > largest.value) largest = {value, question.motion.times.values[i], &*frame};
    };
    if (!summary.nearest.frame || frame->smallest_gap_mm < summary.nearest.value)
      summary.nearest = {frame->smallest_gap_mm, question.motion.times.values[i], &*frame};
    consider(summary.area, totals.area_mm2);
    consider(summary.depth, totals.max_depth_mm);
    consider(summary.pressure, totals.max_pressure_mpa);
    const bool both = question.contact.casting == contact::Casting::both;
    consider(summary.force,
             (both ? frame->on_mobile : contact::Wrench{totals.force_n, totals.moment_nmm}).force_n.norm());
    if (answer.screws.empty() || !answer.screws[i]) continue;
    const motion::ScrewStep& step = *answer.screws[i];
    if (step.is_slide()) ++summary.slides;
    if (!step.axis) continue;
    ++summary.screws;
    if (!step.depth) continue;
    consider(summary.screw_deg, step.depth->degrees());
    consider(summary.screw_mm, *step.depth_mm);
  }
  return summary;
}

/// A frame that is not in balance, and why.
struct OutOfBalance {
  std::size_t frame;
  std::string_view outcome;
  bool carries_load;
  std::string reason;
};

std::vector<OutOfBalance> out_of_balance(const MotionAnswer& answer) {
  std::vector<OutOfBalance> frames;
  for (const std::size_t i : answer.without_load)
    frames.push_back(
        {i, "no_load", false, "the load is zero along the free directions: no pose was searched"});
  for (std::size_t i = 0; i < answer.balanced.size(); ++i) {
    const auto& pose = answer.balanced[i];
    if (pose && pose->outcome != contact::BalanceOutcome::balanced)
      frames.push_back({i, name_of(pose->outcome), pose->carries_load(), contact::reason_of(*pose)});
  }
  std::sort(frames.begin(), frames.end(),
            [](const OutOfBalance& a, const OutOfBalance& b) { return a.frame < b.frame; });
  return frames;
}

/// Frames in each state; null if they were not judged.
Json states_json(const Summary& summary, const MotionAnswer& answer) {
  if (answer.standings.empty()) return nullptr;
  Json states;
  for (std::size_t i = 0; i < summary.states.size(); ++i)
    states[name_of(static_cast<PoseState>(i))] = summary.states[i];
  return states;
}

/// The body whose surface FrameContact::surface is of.
const Body& casting_body(const MotionQuestion& question) {
  return question.contact.casting == contact::Casting::fixed ? question.surfaces.fixed
                                                             : question.surfaces.mobile;
}

/// The frame in which a ligament has most of something; none if it is not known in any.
template <class Frame>
std::optional<std::size_t> frame_of_most(const std::vector<std::optional<Frame>>& frames,
                                         double Frame::*value) {
  std::optional<std::size_t> most;
  for (std::size_t i = 0; i < frames.size(); ++i)
    if (frames[i] && (!most || (*frames[i]).*value > (*frames[*most]).*value)) most = i;
  return most;
}

/// The ligament with most strain, and the one with most tension.
std::string most_strained_text(const MotionAnswer& answer, const FrameTimes& times) {
  std::string text = fmt::format("  {} ligaments", answer.ligaments.size());
  const auto add = [&](const char* what, double LigamentState::*value, const char* unit) {
    const LigamentAlong* of = nullptr;
    std::size_t at = 0;
    for (const LigamentAlong& each : answer.ligaments)
      if (const auto most = frame_of_most(each.frames, value);
          most && (!of || (*each.frames[*most]).*value > (*of->frames[at]).*value))
        of = &each, at = *most;
    if (of)
      text += fmt::format("{} {:.4g}{} of {} at {:g}{}", what, (*of->frames[at]).*value, unit, of->name,
                          times.values[at], times.in_seconds ? " s" : "");
  };
  add(", largest strain", &LigamentState::strain, "");
  add(", largest tension", &LigamentState::tension_n, " N");
  if (answer.speeds_from == SpeedsFrom::recorded) text += ", damped by the file's speeds";
  if (answer.speeds_from == SpeedsFrom::frames) text += ", damped by speeds from one frame to the next";
  return text + "\n";
}

Json ligaments_json(const MotionAnswer& answer, const FrameTimes& times, const char* axis) {
  Json all = Json::array();
  for (const LigamentAlong& ligament : answer.ligaments) {
    const auto most = [&](const auto& frames, auto value) {
      const auto at = frame_of_most(frames, value);
      return at ? Json{{"value", (*frames[*at]).*value}, {axis, times.values[*at]}} : Json(nullptr);
    };
    all.push_back({{"name", ligament.name},
                   {"slack_length_mm", ligament.slack_length_mm},
                   {"frames_known", std::count_if(ligament.frames.begin(), ligament.frames.end(),
                                                  [](const auto& frame) { return frame.has_value(); })},
                   {"largest_length_mm", most(ligament.frames, &LigamentState::length_mm)},
                   {"largest_strain", most(ligament.frames, &LigamentState::strain)},
                   {"largest_tension_n", most(ligament.frames, &LigamentState::tension_n)}});
    if (!ligament.damping.empty())
      all.back()["largest_total_n"] = most(ligament.damping, &LigamentDamping::total_n);
  }
  return all;
}

Json end_json(const MotionQuestion& question, const motion::ContactEnd& end, ContactEndRole role) {
  // Beyond the recording nothing is known.
  const bool is_known = end.kind != motion::ContactEndKind::recording;
  Json json{{"time_s", end.time_s},
            {"kind", name_of(end.kind, role)},
            {"uncertainty_s", is_known ? Json(end.uncertainty_s) : Json(nullptr)},
            {"sample", end.sample},
            {"turned_deg", end.turned.degrees()},
            {"point_mm", nullptr}};
  if (!end.contact) return json;
  const AnswerFrame frame = question.provenance ? question.provenance->frame : AnswerFrame{};
  json["point_mm"] = io::numbers(frame.fixed_point(end.contact->fixed_point));
  const auto& [fixed, mobile] = question.surfaces;
  if (const BodyPart* part = part_of(fixed, end.contact->fixed_feature)) json["fixed_part"] = part->name;
  if (const BodyPart* part = part_of(mobile, end.contact->mobile_feature)) json["mobile_part"] = part->name;
  return json;
}

Json between_json(const MotionQuestion& question, const motion::RecordedContact& between) {
  const auto exact =
      std::count(between.searched.begin(), between.searched.end(), motion::BetweenSamples::exact);
  Json contacts = Json::array();
  for (const motion::ContactInterval& contact : between.contacts)
    contacts.push_back({{"entry", end_json(question, contact.entry, ContactEndRole::entry)},
                        {"exit", end_json(question, contact.exit, ContactEndRole::exit)},
                        {"is_certain", contact.is_certain},
                        {"undecided_s", contact.undecided_s}});
  return {{"ways_exact", exact},
          {"ways_bounded", between.searched.size() - static_cast<std::size_t>(exact)},
          {"contacts", std::move(contacts)}};
}

std::string between_text(const motion::RecordedContact& between) {
  const bool exact =
      std::all_of(between.searched.begin(), between.searched.end(),
                  [](motion::BetweenSamples searched) { return searched == motion::BetweenSamples::exact; });
  std::string text = fmt::format(
      "  between the samples too ({}): {}\n", exact ? "exact" : "bounded where the centre moves",
      between.contacts.empty() ? "no contact" : fmt::format("{} contacts", between.contacts.size()));
  constexpr std::size_t most = 10;
  for (std::size_t i = 0; i < std::min(most, between.contacts.size()); ++i) {
    const motion::ContactInterval& contact = between.contacts[i];
    const auto end = [](const motion::ContactEnd& at, const char* of_recording) {
      return fmt::format("{:.6f} s{}", at.time_s,
                         at.kind == motion::ContactEndKind::recording ? of_recording
                         : at.uncertainty_s > 0
                             ? fmt::format(" within {} s", core::at_most(at.uncertainty_s, 2))
                             : "");
    };
    text += fmt::format("    from {} to {}{}\n", end(contact.entry, " (recording begins)"),
                        end(contact.exit, " (recording ends)"), contact.is_certain ? "" : ", possible only");
  }
  if (between.contacts.size() > most)
    text += fmt::format("    and {} more\n", between.contacts.size() - most);
  return text;
}

}  // namespace

std::string_view name_of(motion::ContactEndKind kind, ContactEndRole role) noexcept {
  return kind == motion::ContactEndKind::exact     ? "exact"
         : kind == motion::ContactEndKind::bounded ? "bounded"
         : role == ContactEndRole::entry           ? "recording_begins"
                                                   : "recording_ends";
}

std::string motion_text(const MotionQuestion& question, const MotionAnswer& answer) {
  const Summary summary = summary_of(question, answer);
  const Joint& joint = question.joint.joint;
  const FrameTimes& times = question.motion.times;
  const char* unit = times.in_seconds ? " s" : "";
  std::string text = fmt::format(
      "{}: {}, {}{:g} to {:g}{}{}\n", joint.name, core::counted(summary.frames, "frame", "frames"),
      times.in_seconds ? "" : "numbers ", times.values.front(), times.values.back(), unit, whose_text(joint));
  text += io::parameters_text(joint);
  if (summary.gaps > 0)
    text += fmt::format("  {}: no answer there\n",
                        core::counted(summary.gaps, "frame is a gap", "frames are gaps"));
  text += io::contact_caveats_text(question.contact, question.surfaces, question.with_pressure);
  for (const std::string& caveat : answer.caveats) text += fmt::format("  {}\n", caveat);
  text += fmt::format("  {} in contact", core::counted(summary.in_contact, "frame", "frames"));
  const bool is_judged = !answer.standings.empty() && summary.count(PoseState::contact) == 0,
             is_bearing = is_judged && summary.in_contact > 0 &&
                          summary.in_contact == summary.count(PoseState::bearing);
  text += is_bearing ? ": bearing contact, which ends no motion\n" : "\n";
  if (is_judged && !is_bearing && summary.in_contact > 0)
    text += fmt::format("    {} impinging, {} at a limit, {} in bearing contact, which ends no motion\n",
                        summary.count(PoseState::impinging), summary.count(PoseState::at_limit),
                        summary.count(PoseState::bearing));
  if (!summary.state_unknown_why.empty())
    text += fmt::format("    any contact ends a motion: {}\n", summary.state_unknown_why);
  const auto at = [&](std::size_t frame) { return fmt::format("{:g}{}", times.values[frame], unit); };
  if (is_judged && summary.tightest)
    text += fmt::format("  smallest clearance {:.4g} mm at {}, of surfaces whose contact ends a motion\n",
                        answer.standings[*summary.tightest]->clearance_mm, at(*summary.tightest));
  if (is_judged && question.to_limits && summary.nearest_limit)
    if (const PoseStanding& nearest = *answer.standings[*summary.nearest_limit]; nearest.nearest)
      text += fmt::format("  nearest to a limit at {}: {:.1f} degrees of {} left\n",
                          at(*summary.nearest_limit), nearest.to_limit_deg(),
                          movement_words(nearest.nearest->vary, nearest.nearest->sense, joint.anatomy));
  const auto line = [&](const char* what, const Summary::Largest& largest, const char* of,
                        const std::string& where = "") {
    if (largest.value > 0)
      text += fmt::format("  largest {} {:.4g} {} at {:g}{}{}\n", what, largest.value, of, largest.at, unit,
                          where);
  };
  if (!is_judged && summary.in_contact == 0 && summary.nearest.frame)
    text +=
        fmt::format("  smallest gap {:.4g} mm at {:g}{}\n", summary.nearest.value, summary.nearest.at, unit);
  line("contact area", summary.area, "mm2");
  const Index deepest = summary.depth.frame ? io::deepest_of(summary.depth.frame->surface)->face : no_index;
  line("depth", summary.depth, "mm",
       deepest == no_index ? ""
                           : fmt::format(", triangle {}{}", deepest,
                                         io::triangle_part_text(casting_body(question), deepest)));
  if (question.with_pressure) {
    line("pressure", summary.pressure, "MPa");
    line("force", summary.force, "N");
    if (answer.refined_largest_force_n)
      text += io::refined_force_text({summary.force.value, 0, 0}, {*answer.refined_largest_force_n, 0, 0});
  }
  if (!answer.ligaments.empty()) text += most_strained_text(answer, times);
  if (answer.between) text += between_text(*answer.between);
  line("angle about the screw of a step", summary.screw_deg, "deg");
  line("arc about the screw of a step", summary.screw_mm, "mm");
  if (summary.slides > 0)
    text += fmt::format("  {} without an axis\n", core::counted(summary.slides, "slide", "slides"));
  if (!answer.balanced.empty()) {
    text += fmt::format("  the load is balanced in {} of {} frames", summary.balanced,
                        summary.frames - summary.gaps);
    text += summary.carried > summary.balanced
                ? fmt::format(", carried unsteadily in {} more\n", summary.carried - summary.balanced)
                : "\n";
    const std::vector<OutOfBalance> frames = out_of_balance(answer);
    constexpr std::size_t most = 3;
    for (std::size_t i = 0; i < std::min(most, frames.size()); ++i)
      text += fmt::format("  {:g}{}: {}\n", times.values[frames[i].frame], unit, frames[i].reason);
  }
  if (summary.from_front > 0)
    text += fmt::format("  in {} frames rays met the open target from its front: overlap there may be none\n",
                        summary.from_front);
  if (summary.oblique > 0)
    text += fmt::format(
        "  in {} frames rays meet the other surface more than 60 degrees off its normal, as along a rim: "
        "{}\n",
        summary.oblique,
        question.contact.rays.rule == contact::FaceRule::cut_faces
            ? "that overlap is counted apart, without a depth"
            : fmt::format(
                  "their length is no depth, and the largest values of {} frames are of such a triangle",
                  summary.oblique_peak));
  if (summary.cut_off > 0)
    text += fmt::format("  in {} the reach of {} mm cuts off rays that would be in contact\n",
                        core::counted(summary.cut_off, "frame", "frames"), question.contact.rays.reach_mm);
  return text;
}

std::string motion_json(const MotionQuestion& question, const MotionAnswer& answer) {
  const Summary summary = summary_of(question, answer);
  const Joint& joint = question.joint.joint;
  const FrameTimes& times = question.motion.times;
  const char* axis = times.in_seconds ? "time_s" : "frame";
  const auto largest = [&](const Summary::Largest& of) {
    return Json{{"value", of.value}, {axis, of.frame ? Json(of.at) : Json(nullptr)}};
  };
  Json json{{"condyle", io::format_version},
            {"joint", joint.name},
            {"fixed", question.surfaces.fixed.name},
            {"mobile", question.surfaces.mobile.name},
            {"anatomy", io::anatomy_json(joint)},
            {"side", name_of(joint.side)},
            {"motion_file",
             {{"path", question.motion.path.string()},
              {"bytes", question.motion.digest.bytes},
              {"sha256", question.motion.digest.sha256}}},
            {"contact", io::contact_caveats(question.contact, question.with_pressure)},
            {"frames", summary.frames},
            {"gaps", summary.gaps},
            {"first", times.values.front()},
            {"last", times.values.back()},
            {"along", axis},
            {"frames_in_contact", summary.in_contact},
            {"frames_met_from_front", summary.from_front},
            {"frames_cut_off_by_reach", summary.cut_off},
            {"frames_with_oblique_area", summary.oblique},
            {"frames_with_oblique_peak", summary.oblique_peak},
            {"states", states_json(summary, answer)},
            {"state_unknown_why",
             summary.state_unknown_why.empty() ? Json(nullptr) : Json(summary.state_unknown_why)},
            {"smallest_clearance_mm", nullptr},
            {"least_to_limit_deg", nullptr},
            {"smallest_gap_mm", summary.nearest.frame ? largest(summary.nearest) : Json(nullptr)},
            {"largest_area_mm2", largest(summary.area)},
            {"largest_depth_mm", largest(summary.depth)}};
  if (summary.tightest && std::isfinite(answer.standings[*summary.tightest]->clearance_mm))
    json["smallest_clearance_mm"] = {{"value", answer.standings[*summary.tightest]->clearance_mm},
                                     {axis, times.values[*summary.tightest]}};
  if (question.to_limits && summary.nearest_limit) {
    const PoseStanding& nearest = *answer.standings[*summary.nearest_limit];
    json["least_to_limit_deg"] = {
        {"value", nearest.to_limit_deg()},
        {axis, times.values[*summary.nearest_limit]},
        {"movement", nearest.nearest
                         ? Json(movement_name(nearest.nearest->vary, nearest.nearest->sense, joint.anatomy))
                         : Json(nullptr)}};
  }
  if (summary.depth.frame) {
    const Index deepest = io::deepest_of(summary.depth.frame->surface)->face;
    json["largest_depth_mm"]["triangle"] = deepest;
    io::add_triangle_part(json["largest_depth_mm"], "part", casting_body(question), deepest);
  }
  if (question.with_pressure) {
    json["largest_pressure_mpa"] = largest(summary.pressure);
    json["largest_force_n"] = largest(summary.force);
    json["largest_force_n"]["refined"] = io::nullable(answer.refined_largest_force_n);
  }
  if (!answer.ligaments.empty()) {
    json["ligaments"] = ligaments_json(answer, times, axis);
    json["ligament_speeds_from"] = name_of(answer.speeds_from);
  }
  json["caveats"] = answer.caveats;
  if (!answer.balanced.empty()) {
    json["frames_balanced"] = summary.balanced;
    json["frames_carrying_load"] = summary.carried;
    Json without = Json::array();
    for (const OutOfBalance& of : out_of_balance(answer))
      without.push_back({{axis, times.values[of.frame]},
                         {"outcome", of.outcome},
                         {"carries_load", of.carries_load},
                         {"reason", of.reason}});
    json["without_balance"] = without;
  }
  json["screws"] = answer.screws.empty() ? Json(nullptr)
                                         : Json{{"steps", summary.screws},
                                                {"slides", summary.slides},
                                                {"slide_below_deg", motion::slide_below_deg},
                                                {"largest_depth_deg", largest(summary.screw_deg)},
                                                {"largest_depth_mm", largest(summary.screw_mm)}};
  json["between_samples"] = answer.between ? between_json(question, *answer.between) : Json(nullptr);
  json["processing"] = question.motion.processing;
  json["notes"] = io::notes_json(question.notes, answer.notes);
  json["scope"] = scope_text(question.contact, question.surfaces);
  json["provenance"] = io::provenance_json(question.provenance);
  return io::document(std::move(json));
}

}  // namespace condyle::io
