#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <exception>
#include <functional>
#include <mutex>

#include "answer/check_gains.hpp"
#include "answer/limit_facts.hpp"
#include "answer/margin_search.hpp"
#include "answer/surface_notes.hpp"
#include "condyle/answer.hpp"
#include "condyle/error.hpp"
#include "core/formatted.hpp"
#include "core/parallel.hpp"
#include "motion/rom/displaced_joint.hpp"
#include "motion/rom/displacement.hpp"
#include "plan/check_target.hpp"
#include "plan/cut_for.hpp"

namespace condyle {
namespace {

using core::formatted;

/// The share whose plan is given beside the requested one.
constexpr double other_confidence = 0.8;

/// How much bone may go beside what must, without a note: a share of that, and mm3.
constexpr double unasked_share = 0.1, unasked_mm3 = 0.5;

/// An alpha angle that falls by less stays as it was, as far as the contour shows.
constexpr double alpha_unchanged_deg = 1;

/// A limit that changes by less counts as unchanged, and by less than the second the cut does not move it.
constexpr double no_change_deg = 0.05, unmoved_deg = 1e-6;

/// Counts the cuts that are done, of as many as there may be. From any thread.
class Cuts {
 public:
  Cuts(const Joint& joint, const motion::RangeOfMotion& before, const Control& control, std::size_t total)
      : joint_(joint), before_(before), control_(control), total_(total) {}

  /// Empty if it was stopped. Where targets end after it is left open.
  std::optional<plan::Resection> operator()(const plan::ResectionOptions& request,
                                            plan::CutFacts facts = plan::CutFacts::all_but_limits) {
    auto cut = plan::cut_for(joint_, request, before_, facts, {.stop = control_.stop});
    const std::scoped_lock lock(counting_);
    done_ = std::min(done_ + 1, total_);
    if (cut && control_.progress) control_.progress("cuts", done_, total_);
    return cut;
  }

 private:
  const Joint& joint_;
  const motion::RangeOfMotion& before_;
  const Control& control_;
  std::mutex counting_;
  std::size_t done_ = 0, total_;
};

std::string in_degrees(Angle angle) {
  return formatted("%.1f", angle.degrees());
}

std::string what_is_kept(plan::KeptBy by, const std::string& body) {
  switch (by) {
    case plan::KeptBy::bearing:
      return "the bearing surface of " + body;
    case plan::KeptBy::depth:
      return "bone of " + body + " that lies deeper than may be removed";
    case plan::KeptBy::zone:
      return "bone of " + body + " that lies farther from the bearing surface than may be removed";
    case plan::KeptBy::marked:
      break;
  }
  return "bone of " + body + " that is marked to stay";
}

/// The largest share of the neck's width, across it where a vertex lies, that goes there; 0 if the cut is not at the neck.
double share_of_neck(const plan::CutBone& cut, const measure::HipMeasures& shape) {
  if (!shape.femur.neck || shape.femur.neck->outline.empty()) return 0;
  const measure::NeckGeometry& neck = *shape.femur.neck;
  double share = 0;
  for (std::size_t v = 0; v < cut.depth_mm.size(); ++v) {
    if (cut.depth_mm[v] == 0) continue;
    const Vec3 from_head = cut.before.vertices[v] - neck.head.centre;
    // Between the head and the trochanters.
    const double along = from_head.dot(neck.direction) / neck.head.radius;
    if (!(along > 0.3 && along < 2)) continue;
    const Vec3 across = (from_head - from_head.dot(neck.direction) * neck.direction).stableNormalized();
    double least = 0, most = 0;
    for (const Vec3& p : neck.outline) {
      const double at = (p - neck.head.centre).dot(across);
      least = std::min(least, at), most = std::max(most, at);
    }
    if (most > least) share = std::max(share, cut.depth_mm[v] / (most - least));
  }
  return share;
}

void note_targets(ResectionAnswer& answer) {
  const auto& targets = answer.resection.targets;
  const bool nothing = !answer.resection.mobile && !answer.resection.fixed;
  if (nothing && std::none_of(targets.begin(), targets.end(), [](const auto& each) { return each.blocked; }))
    answer.notes.push_back(
        {ResectionNoteCode::nothing_to_do, "the joint reaches every target: no bone has to go"});
  for (const plan::ReachOutcome& outcome : targets) {
    if (!outcome.blocked) continue;
    const Body& body = outcome.blocked->body == BodyRole::mobile ? answer.resection.joint.mobile
                                                                 : answer.resection.joint.fixed;
    const Vec3& p = outcome.blocked->point_mm;
    const std::string margin =
        answer.margin_mm > 0 ? formatted(" with a margin of %.6g mm", answer.margin_mm) : std::string();
    answer.notes.push_back({ResectionNoteCode::target_blocked,
                            outcome.target.motion.name + " cannot reach " + in_degrees(outcome.target.reach) +
                                " degrees" + margin + ": " + what_is_kept(outcome.blocked->by, body.name) +
                                formatted(", at (%.1f, %.1f, %.1f) mm,", p.x(), p.y(), p.z()) +
                                " stops it at " + in_degrees(outcome.planned)});
  }
}

/// What the limits after the cut must be read with. Of sliding surfaces, which a cut may take, a note of the cut says more.
void note_limits(ResectionAnswer& answer, const Joint& before, const motion::BearingFinding& bearing_before,
                 const motion::BearingFinding& bearing, const motion::RangeOptions& range) {
  answer.limit_notes = range_notes(answer.resection.joint, answer.after, range, bearing);
  std::erase_if(answer.limit_notes,
                [](const RangeNote& note) { return note.code == RangeNoteCode::sliding_surfaces; });
  if (before.has_head()) return;
  for (const RangeNote& note : range_notes(before, answer.before, range, bearing_before))
    if (note.code == RangeNoteCode::sliding_surfaces)
      answer.notes.push_back(
          {ResectionNoteCode::sliding_surfaces, note.text + "; removed bone may belong to those surfaces"});
}

void note_bones(ResectionAnswer& answer) {
  if (answer.resection.sweeps_bearing)
    answer.notes.push_back({ResectionNoteCode::bearing_is_swept,
                            answer.resection.joint.mobile.name +
                                ": on the way the other bone sweeps over its bearing surface, "
                                "whose contact counts for nothing"});
  if (answer.resection.mobile && answer.shape_before) {
    const double share = share_of_neck(*answer.resection.mobile, *answer.shape_before);
    if (share > neck_width_share)
      answer.notes.push_back({ResectionNoteCode::neck_is_narrowed,
                              formatted("the cut takes %.0f %% of the neck's width at one place, more than "
                                        "%.0f %%: how strong the neck still is, is not modelled",
                                        100 * share, 100 * neck_width_share)});
    const auto &before = answer.shape_before->femur.alpha_largest.value,
               &after = answer.shape_after->femur.alpha_largest.value;
    if (share > 0 && before && after && *after > *before - alpha_unchanged_deg)
      answer.notes.push_back(
          {ResectionNoteCode::alpha_stays,
           formatted(
               "the largest alpha angle stays, %.1f degrees before and %.1f after: it is read where the "
               "surface leaves the head's sphere, and bone there that no target meets stays",
               *before, *after)});
  }
  for (const auto* cut : {&answer.resection.mobile, &answer.resection.fixed}) {
    if (!*cut) continue;
    const double unasked = (*cut)->volume_mm3 - (*cut)->burr_volume_mm3 - (*cut)->least_volume_mm3;
    if (unasked > unasked_share * (*cut)->least_volume_mm3 + unasked_mm3)
      answer.notes.push_back(
          {ResectionNoteCode::more_than_must,
           (*cut)->body.name +
               formatted(": %.1f mm3 go that no target needs: bone above an overhang, or triangles that lie "
                         "partly in the bearing ball and are met as a whole",
                         unasked)});
    if ((*cut)->edge_reason != plan::EdgeReason::requested)
      answer.notes.push_back(
          {ResectionNoteCode::edge_changed,
           (*cut)->body.name +
               formatted(": triangles around the cut have edges up to %g mm, ", (*cut)->edge_mm) +
               ((*cut)->edge_reason == plan::EdgeReason::too_many
                    ? "as smaller ones would be more than " + std::to_string(plan::most_triangles_added)
                    : "as with longer ones the cut turns triangles over or runs through itself")});
    if ((*cut)->burr_in_kept_mm > 0)
      answer.notes.push_back(
          {ResectionNoteCode::burr_meets_kept,
           (*cut)->body.name + formatted(": a burr this wide would have to enter bone that stays by %.2f mm: "
                                         "there the cut is narrower than it",
                                         (*cut)->burr_in_kept_mm)});
  }
}

/// The joint with the triangles of the cut bones where their surface was.
Joint with_finer_triangles(const plan::Resection& resection) {
  Joint joint = resection.joint;
  for (const auto& [cut, body] :
       {std::pair(&resection.mobile, &joint.mobile), std::pair(&resection.fixed, &joint.fixed)})
    if (*cut) body->mesh = body->mesh.moved_to((*cut)->before.vertices);
  return joint;
}

/// What the requested share of varied joints gains at the least in a motion.
Angle gain_of_share(const motion::LimitBand& before, const motion::LimitBand& after, double share) {
  std::vector<double> gains;
  for (std::size_t i = 0; i < before.turned.size(); ++i)
    gains.push_back((after.turned[i] - before.turned[i]).radians());
  std::sort(gains.begin(), gains.end());
  return Angle::radians(motion::quantile(gains, 1 - share));
}

/// A limit's gain through smaller triangles does not count as a gain of the cut. Without a gain the limit is the one before.
void take_gains(ResectionAnswer& answer, const Joint& finer, const motion::RangeOptions& range,
                std::span<const motion::Motion> motions) {
  const std::vector<motion::MotionLimit> limits = motion::RangeOfMotion(finer, range).limits(motions);
  for (std::size_t i = 0; i < limits.size(); ++i) {
    const Angle was = answer.before[i].end.turned, is = limits[i].end.turned, by_triangles = is - was;
    const auto of_cut = [&](Angle gained) {
      return gained > Angle() && by_triangles > Angle() ? std::max(gained - by_triangles, Angle()) : gained;
    };
    motion::MotionLimit& after = answer.after[i];
    answer.gain.push_back(of_cut(after.end.turned - was));
    const bool is_unmoved = std::abs(answer.gain[i].degrees()) < unmoved_deg;
    if (is_unmoved)
      after.end.turned = was, after.end.reason = answer.before[i].end.reason, answer.gain[i] = {};
    for (std::size_t t = 0; t < answer.promises.size(); ++t) {
      plan::ReachOutcome& outcome = answer.resection.targets[t];
      if (outcome.target.motion.name != after.motion.name) continue;
      outcome.after.end.turned = after.end.turned;
      if (answer.promises[t].after && !is_unmoved)
        answer.gain[i] = of_cut(gain_of_share(*answer.promises[t].before, *answer.promises[t].after,
                                              answer.confidence.value_or(0.5)));
    }
    if (is.degrees() > was.degrees() + no_change_deg)
      answer.notes.push_back({ResectionNoteCode::finer_triangles,
                              motions[i].name + " ends at " + in_degrees(was) + " degrees, and at " +
                                  in_degrees(is) +
                                  " with smaller triangles of the same surface, those in the bearing ball "
                                  "left out: from there on the cut counts"});
  }
}

void note_gains(ResectionAnswer& answer) {
  if (!answer.resection.mobile && !answer.resection.fixed) return;
  std::string same;
  for (std::size_t i = 0; i < answer.before.size(); ++i) {
    const auto& targets = answer.resection.targets;
    if (std::any_of(targets.begin(), targets.end(), [&](const plan::ReachOutcome& outcome) {
          return !outcome.blocked && outcome.target.motion.name == answer.before[i].motion.name;
        }))
      continue;
    if (answer.before[i].end.reason == motion::LimitReason::contact &&
        answer.gain[i].degrees() < no_change_deg)
      same += (same.empty() ? "" : ", ") + answer.before[i].motion.name;
  }
  if (!same.empty())
    answer.notes.push_back({ResectionNoteCode::no_gain, "these motions gain nothing: " + same});
}

/// The plan with which the requested share reaches the targets; false if it was stopped. If kept bone blocks all of them no margin helps.
bool reach_share(const ResectionRequest& request, const motion::BandOptions& displaced,
                 const Control& control, Cuts& cuts, ResectionAnswer& answer) {
  const std::vector<plan::ReachOutcome>& targets = answer.resection.targets;
  if (std::all_of(targets.begin(), targets.end(), [](const auto& target) { return target.blocked; }))
    return true;
  MarginSearch search(request, displaced, control, std::ref(cuts));
  if (!search.add(answer.margin_mm, std::move(answer.resection))) return false;
  std::optional<double> margin_mm;
  for (const double share : {*request.confidence, other_confidence}) {
    if (margin_mm && share == *request.confidence) continue;
    const auto found = search.margin_for(share);
    if (control.stop.stop_requested()) return false;
    if (share == *request.confidence) margin_mm = found.value_or(search.widest_mm());
    if (found)
      answer.alternatives.push_back({share, *found, search.cut(*found).volume_mm3()});
    else
      answer.notes.push_back(
          {ResectionNoteCode::band_not_reached,
           formatted("no margin up to %.3g mm reaches the targets in %.4g %% of %zu varied joints",
                     search.tried_to_mm(), 100 * share, displaced.samples)});
  }
  answer.margin_mm = *margin_mm;
  answer.resection = search.cut(*margin_mm);
  return true;
}

/// Bands of all motions before and after the cut, and in how many varied joints it reaches the targets; false if it was stopped.
bool judge(const Joint& before, const ResectionRequest& request, const motion::BandOptions& displaced,
           const Control& control, ResectionAnswer& answer) {
  std::vector<motion::Motion> motions = request.motions;
  for (const plan::ReachTarget& target : request.resection.targets) motions.push_back(target.motion);
  const plan::Resection& cut = answer.resection;
  auto bands = motion::bands_without_widths(before, motions, request.resection.range, displaced, control);
  auto after = bands;
  if (bands && (cut.mobile || cut.fixed))
    after = motion::bands_without_widths(cut.joint, motions, request.resection.range, displaced, control);
  if (!bands || !after) return false;
  answer.displaced = displaced.samples;
  for (std::size_t i = 0; i < cut.targets.size(); ++i) {
    ResectionAnswer::TargetPromise& promise = answer.promises[i];
    promise.before = (*bands)[request.motions.size() + i];
    promise.after = (*after)[request.motions.size() + i];
    const auto& turned = promise.after->turned;
    const auto reaches = std::count_if(
        turned.begin(), turned.end(), [&](Angle each) { return each >= request.resection.targets[i].reach; });
    promise.confidence_reached = static_cast<double>(reaches) / static_cast<double>(turned.size());
  }
  bands->resize(request.motions.size()), after->resize(request.motions.size());
  answer.bands_before = std::move(*bands), answer.bands_after = std::move(*after);
  return true;
}

/// The targets before and after the cut if the joint turned about the other one of its two centres.
void add_other_centre(const Joint& before, const motion::BearingFinding& bearing,
                      const motion::RangeOptions& range, ResectionAnswer& answer) {
  const auto apart = bearing.surface && before.is_hip()
                         ? answer::centres_apart(before, range, *bearing.surface)
                         : std::nullopt;
  if (!apart) return;
  // The joint's own centre is the origin.
  const bool is_socket = apart->socket.norm() > apart->head.norm();
  const std::array centres{is_socket ? apart->socket : apart->head};
  const plan::Resection& cut = answer.resection;
  std::vector<motion::Motion> motions;
  for (const plan::ReachOutcome& outcome : cut.targets) motions.push_back(outcome.target.motion);
  const auto now = motion::limits_about(before, motions, range, centres),
             then = motion::limits_about(cut.joint, motions, range, centres);
  for (std::size_t i = 0; i < motions.size(); ++i) {
    const plan::ReachOutcome& outcome = cut.targets[i];
    const bool reaches = outcome.after.end.turned >= outcome.target.reach;
    answer.promises[i].other_centre = {is_socket ? BodyRole::fixed : BodyRole::mobile, now[i].turned,
                                       then[i].turned, (then[i].turned >= outcome.target.reach) == reaches};
    answer.promises[i].is_plan = !(cut.mobile || cut.fixed) || then[i].turned >= outcome.before.end.turned;
  }
}

/// "reaches 42.6 in 50 % of 200 varied hips, 281 mm3; in 80 %: 455 mm3; 42.6 deg about the head's centre (now 32.6), 25.1 about the socket's
/// (now 18.0): not decided".
std::string promise_text(const ResectionAnswer& answer, std::size_t i) {
  const plan::ReachOutcome& outcome = answer.resection.targets[i];
  const auto& [reached, before, after, other, is_plan, text] = answer.promises[i];
  const double reach = outcome.target.reach.degrees(), ends = outcome.after.end.turned.degrees();
  std::string said = outcome.after.end.turned >= outcome.target.reach
                         ? formatted("reaches %.1f", reach)
                         : formatted("ends at %.1f, short of %.1f", ends, reach);
  if (reached)
    said += formatted("%s in %.0f %% of %zu varied %s", said.starts_with("ends") ? ", which it reaches" : "",
                      100 * *reached, answer.displaced, answer.resection.joint.is_hip() ? "hips" : "joints") +
            formatted(", %.4g mm3", answer.resection.volume_mm3());
  for (const ResectionAnswer::Alternative& each : answer.alternatives)
    if (each.confidence != answer.confidence && !outcome.blocked)
      said += formatted("; in %.4g %%: %.4g mm3", 100 * each.confidence, each.volume_mm3);
  if (!other) return said;
  const char* const names[] = {"the head's", "the socket's"};
  const bool is_socket = other->of == BodyRole::fixed;
  const std::string centres =
      formatted("%.1f deg about %s centre (now %.1f), %.1f about %s (now %.1f): %s", ends, names[!is_socket],
                outcome.before.end.turned.degrees(), other->after.degrees(), names[is_socket],
                other->before.degrees(), other->is_decided ? "decided" : "not decided");
  if (is_plan) return said + "; " + centres;
  return "no plan: " + centres + ", and the choice of a centre takes more than the cut gives";
}

void note_promises(ResectionAnswer& answer) {
  for (std::size_t i = 0; i < answer.promises.size(); ++i) {
    ResectionAnswer::TargetPromise& promise = answer.promises[i];
    promise.text = promise_text(answer, i);
    if (promise.other_centre && !(promise.is_plan && promise.other_centre->is_decided))
      answer.notes.push_back({promise.is_plan ? ResectionNoteCode::not_decided : ResectionNoteCode::no_plan,
                              answer.resection.targets[i].target.motion.name + ": " + promise.text});
  }
}

/// The reach, volume and depth of a cut.
ResectionAnswer::CurvePoint curve_point(std::size_t target, Angle reach, const plan::Resection& cut) {
  return {target, reach, cut.volume_mm3(),
          std::max(cut.mobile ? cut.mobile->deepest_mm : 0, cut.fixed ? cut.fixed->deepest_mm : 0)};
}

/// False if it was stopped.
bool add_curve(const ResectionRequest& request, Cuts& cuts, ResectionAnswer& answer) {
  struct Point {
    std::size_t target;
    Angle reach;
    std::optional<ResectionAnswer::CurvePoint> found = {};
    std::exception_ptr failure = {};
  };
  std::vector<Point> points;
  for (std::size_t i = 0; i < answer.resection.targets.size(); ++i) {
    const plan::ReachOutcome& outcome = answer.resection.targets[i];
    const Angle from = outcome.before.end.turned;
    if (!(outcome.planned > from)) continue;
    const std::size_t count = request.curve_points;
    for (std::size_t k = 1; k < count; ++k)
      points.push_back(
          {i, from + (outcome.planned - from) * (static_cast<double>(k) / static_cast<double>(count))});
    points.push_back({i, outcome.planned});
    // The plan itself, if it has no other target and nothing blocks this one.
    if (answer.resection.targets.size() == 1 && !outcome.blocked)
      points.back().found = curve_point(i, outcome.planned, answer.resection);
  }
  core::parallel_chunks(points.size(), 1, [&](std::size_t first, std::size_t last) {
    for (Point& point : std::span(points).subspan(first, last - first)) {
      if (point.found) continue;
      plan::ResectionOptions one = request.resection;
      one.margin_mm = answer.margin_mm;
      one.targets = {{answer.resection.targets[point.target].target.motion, point.reach}};
      try {
        core::isolated([&] {
          if (const auto cut = cuts(one, plan::CutFacts::curve))
            point.found = curve_point(point.target, cut->targets.front().planned, *cut);
        });
      } catch (...) {
        point.failure = std::current_exception();
      }
    }
  });
  for (const Point& point : points) {
    if (point.failure) std::rethrow_exception(point.failure);
    if (!point.found) return false;
    answer.curve.push_back(*point.found);
  }
  return true;
}

}  // namespace

std::string_view name_of(ResectionNoteCode code) noexcept {
  switch (code) {
    case ResectionNoteCode::nothing_to_do:
      return "nothing_to_do";
    case ResectionNoteCode::target_blocked:
      return "target_blocked";
    case ResectionNoteCode::band_not_reached:
      return "band_not_reached";
    case ResectionNoteCode::not_decided:
      return "not_decided";
    case ResectionNoteCode::no_plan:
      return "no_plan";
    case ResectionNoteCode::bearing_is_swept:
      return "bearing_is_swept";
    case ResectionNoteCode::neck_is_narrowed:
      return "neck_is_narrowed";
    case ResectionNoteCode::no_gain:
      return "no_gain";
    case ResectionNoteCode::alpha_stays:
      return "alpha_stays";
    case ResectionNoteCode::edge_changed:
      return "edge_changed";
    case ResectionNoteCode::burr_meets_kept:
      return "burr_meets_kept";
    case ResectionNoteCode::sliding_surfaces:
      return "sliding_surfaces";
    case ResectionNoteCode::more_than_must:
      return "more_than_must";
    case ResectionNoteCode::stopped:
      return "stopped";
    case ResectionNoteCode::finer_triangles:
      break;
  }
  return "finer_triangles";
}

std::vector<NamedReach> parse_reach(std::string_view text) {
  std::vector<NamedReach> named;
  while (true) {
    const auto first = text.find_first_not_of(" \t,");
    if (first == text.npos) break;
    text.remove_prefix(first);
    const auto end = std::min(text.find_first_of(" \t,"), text.size());
    const std::string_view item = text.substr(0, end);
    text.remove_prefix(end);
    const auto equals = item.find('=');
    double degrees = 0;
    auto number = equals == item.npos ? std::string_view() : item.substr(equals + 1);
    const bool is_gain = number.starts_with('+');
    if (is_gain) number.remove_prefix(1);
    const auto [stopped, error] = std::from_chars(number.data(), number.data() + number.size(), degrees);
    if (equals == item.npos || equals == 0 || error != std::errc() ||
        stopped != number.data() + number.size() || !std::isfinite(degrees))
      throw UsageError("targets: \"" + std::string(item) +
                       "\" is not a motion and its degrees, as in flexion=115, or what it shall gain, as in "
                       "flexion=+10");
    named.push_back({std::string(item.substr(0, equals)), Angle::degrees(degrees), is_gain});
  }
  if (named.empty()) throw UsageError("targets: none is given, as in flexion=115");
  return named;
}

std::vector<plan::ReachTarget> reach_targets(std::span<const motion::Motion> motions,
                                             std::span<const NamedReach> named) {
  std::vector<plan::ReachTarget> targets;
  for (const auto& [motion, reach, is_gain] : named)
    plan::check_target(
        targets.emplace_back(plan::ReachTarget{motion::motion_named(motions, motion), reach, is_gain}));
  return targets;
}

std::vector<plan::ReachTarget> reach_targets(std::span<const motion::Motion> motions, std::string_view text) {
  return reach_targets(motions, parse_reach(text));
}

void check_gains(const Case& of, const RangeRequest& range, const ResectionRequest& request) {
  plan::ResectionOptions options = request.resection;
  options.range = range.range;
  options.range.overlap.reference_pose = of.placement.reference_pose.angles;
  try {
    (void)plan::with_gains_resolved(of.joint, options);
  } catch (const MeshError&) {  // of limits: those who compute them report it
  }
}

std::optional<ResectionAnswer> answer_resection(const Case& of, const ResectionRequest& request,
                                                const Control& control) {
  ResectionRequest asked = request;
  asked.resection.range.overlap.reference_pose = of.placement.reference_pose.angles;
  if (asked.motions.empty()) asked.motions = of.motions();
  const auto held = held_translation(of, {});
  const Joint at = held && *held != Vec3::Zero() ? held_at(of.joint, *held) : of.joint;
  asked.resection = plan::with_gains_resolved(at, asked.resection);
  if (asked.confidence && !(*asked.confidence > 0 && *asked.confidence < 1))
    throw UsageError("resection: the confidence must be above 0 and below 1");
  if (!asked.bands) asked.confidence.reset();
  const motion::RangeOfMotion range(at, asked.resection.range);
  Cuts cuts(at, range, control,
            1 + asked.resection.targets.size() * asked.curve_points +
                (asked.confidence ? MarginSearch::most_margins : 0));
  auto first = cuts(asked.resection);
  if (!first) return std::nullopt;
  ResectionAnswer answer{.resection = std::move(*first)};
  answer.margin_mm = asked.resection.margin_mm;
  answer.confidence = asked.confidence;
  answer.promises.resize(asked.resection.targets.size());
  bool is_judged = true;
  if (asked.bands) {
    ResectionAnswer judged = answer;
    const motion::BandOptions displaced = band_options(of, *asked.bands);
    is_judged = (!asked.confidence || reach_share(asked, displaced, control, cuts, judged)) &&
                judge(at, asked, displaced, control, judged);
    if (!is_judged && !asked.keep_if_stopped) return std::nullopt;
    if (is_judged)
      answer = std::move(judged);
    else
      answer.confidence.reset();
  }
  answer.before = range.limits(asked.motions);
  const motion::RangeOfMotion range_after(answer.resection.joint, asked.resection.range);
  answer.after = range_after.limits(asked.motions);
  for (plan::ReachOutcome& outcome : answer.resection.targets)
    outcome.after = range_after.limit(outcome.target.motion);
  // Compared on the same triangles: what a measure takes of a surface depends a little on them.
  const Joint finer = with_finer_triangles(answer.resection);
  if (is_judged && at.is_hip() && at.kind != JointKind::hinge) {
    answer.shape_before = measure::measure_hip(finer, of.measure_options());
    answer.shape_after = measure::measure_hip(answer.resection.joint, of.measure_options());
  }
  const bool has_curve = is_judged && (asked.curve_points == 0 || add_curve(asked, cuts, answer));
  if (!has_curve) {
    if (!asked.keep_if_stopped) return std::nullopt;
    answer.curve.clear();
    answer.notes.push_back(
        {ResectionNoteCode::stopped,
         is_judged ? "ended while curves of volume were made: they are left out"
                   : "ended before varied joints were tried: the cut is for the joint as given; a margin "
                     "for a share of them, the shape of the hip and curves are left out"});
  }
  note_targets(answer);
  take_gains(answer, finer, asked.resection.range, asked.motions);
  add_other_centre(at, range.bearing(), asked.resection.range, answer);
  note_promises(answer);
  note_bones(answer);
  if (answer.resection.mobile || answer.resection.fixed)
    note_limits(answer, at, range.bearing(), range_after.bearing(), asked.resection.range);
  note_gains(answer);
  answer.caveats = range_caveats(asked.resection.range, range);
  answer.caveats.emplace_back(
      "osseous only: labrum, cartilage, capsule and the strength of the remaining bone are not modelled");
  if (answer.resection.joint.is_hip() && !answer.resection.joint.implant)
    answer.caveats.emplace_back(
        "a year after arthroscopy, which had taken 406 to 1783 mm3, 13 patients were better and moved no "
        "farther than before, whatever the volume (doi 10.1186/s40634-021-00427-x); in seven cadavers "
        "internal rotation rose from 19.1 to 21.9 degrees (doi 10.1186/s40634-017-0096-2)");
  return answer;
}

ResectionAnswer answer_resection(const Case& joint, const ResectionRequest& request) {
  return *answer_resection(joint, request, {});
}

}  // namespace condyle
