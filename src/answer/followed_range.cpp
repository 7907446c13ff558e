#include "answer/followed_range.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "condyle/error.hpp"
#include "core/formatted.hpp"

namespace condyle {
namespace {

using core::formatted;
using Knots = std::vector<motion::TranslationKnot>;

/// Where a recorded motion leads along a motion, from before its start; or why it does not.
struct RecordedTranslation {
  Knots knots = {};  ///< angles ascend in the motion's sense, from 0 or below
  std::string why_none = {};
};

/// A joint that is kept still may still move by so much.
constexpr Angle still = Angle::degrees(1e-3);

/// From the last knot at the first one's angle to the first at the last one's: a joint may be kept still before a motion and
/// after it. All of them if it was not.
Knots without_still_ends(const Knots& knots) {
  const Angle low = knots.front().turned, high = knots.back().turned;
  const auto first = std::find_if(knots.rbegin(), knots.rend(),
                                  [&](const motion::TranslationKnot& knot) { return knot.turned <= low; })
                         .base() -
                     1;
  const auto last = std::find_if(knots.begin(), knots.end(),
                                 [&](const motion::TranslationKnot& knot) { return knot.turned >= high; });
  const auto stands_at = [](Angle angle) {
    return [angle](const motion::TranslationKnot& knot) {
      return std::abs((knot.turned - angle).degrees()) <= still.degrees();
    };
  };
  const bool holds = first < last && std::all_of(knots.begin(), first, stands_at(low)) &&
                     std::all_of(last, knots.end(), stands_at(high));
  return holds ? Knots(first, last + 1) : knots;
}

RecordedTranslation recorded_translation(const motion::Motion& motion, const FollowRecord& record) {
  RecordedTranslation out;
  for (const JointCoordinates& frame : record.frames) {
    const Angle turned =
        (angle_of(frame.angles, motion.vary) - angle_of(motion.start, motion.vary)) * sign_of(motion.sense);
    out.knots.push_back({turned, frame.translation_mm});
  }
  Knots& knots = out.knots;
  if (knots.size() < 2) return {{}, "the recorded motion has fewer than two frames"};
  if (knots.back().turned < knots.front().turned) std::reverse(knots.begin(), knots.end());
  knots = without_still_ends(knots);
  const auto back = std::adjacent_find(knots.begin(), knots.end(),
                                       [](const auto& a, const auto& b) { return !(a.turned < b.turned); });
  if (back != knots.end())
    return {{},
            formatted("the recorded angle turns back, or stands still, %.4g degrees past the motion's start: "
                      "a part is needed in which it only grows or only falls",
                      back->turned.degrees() + 0.0)};
  if (knots.front().turned > Angle())
    return {{},
            formatted("the recorded angle begins %.4g degrees past the motion's start",
                      knots.front().turned.degrees())};
  if (!(knots.back().turned > still)) return {{}, "the recorded angle does not go past the motion's start"};
  return out;
}

/// The knots from the motion's start on.
Knots from_start(const Knots& all) {
  const auto after =
      std::find_if(all.begin(), all.end(), [](const auto& knot) { return knot.turned > Angle(); });
  const motion::TranslationKnot &high = *after, &low = *(after - 1);
  const double share = -low.turned.radians() / (high.turned - low.turned).radians();
  Knots knots{{Angle(), low.translation_mm + share * (high.translation_mm - low.translation_mm)}};
  knots.insert(knots.end(), after, all.end());
  return knots;
}

/// Balances one step after another; keeps why it ended.
class BalancedTranslation {
 public:
  BalancedTranslation(const Joint& joint, const motion::Motion& motion, const FollowLoad& follow,
                      const Vec3& start_mm)
      : joint_(joint), motion_(motion), follow_(follow), last_mm_(start_mm) {}

  std::optional<motion::TranslationKnot> next(std::span<const motion::TranslationKnot> before) {
    const Angle turned =
        before.empty() ? Angle() : std::min(before.back().turned + follow_.step, motion_.range);
    if (!before.empty() && !(before.back().turned < turned)) return std::nullopt;
    const JointAngles angles =
        motion::turned_by(motion_.start, motion_.vary, turned * sign_of(motion_.sense));
    const CoordinateSystem system = joint_.coordinates();
    const Pose start = pose_at(system, JointCoordinates{angles, last_mm_}, joint_.translation_frame);
    const contact::BalancedPose balanced =
        contact::balance(*follow_.layers, start, follow_.load, follow_.balance);
    if (!balanced.carries_load()) {
      ended_by_ = formatted("no contact carries the load %.4g degrees past its start: ", turned.degrees()) +
                  contact::reason_of(balanced);
      return std::nullopt;
    }
    last_mm_ = coordinates_at(system, balanced.X_FM, joint_.translation_frame).translation_mm;
    note_bend(before, last_mm_);
    return motion::TranslationKnot{turned, last_mm_};
  }

  const std::string& ended_by() const noexcept { return ended_by_; }
  /// Approximate distance between the balanced path and straight pieces of it: an eighth of its second difference.
  double bend_mm() const noexcept { return bend_mm_; }

 private:
  void note_bend(std::span<const motion::TranslationKnot> before, const Vec3& now) {
    if (before.size() < 2) return;
    const Vec3 &a = before[before.size() - 2].translation_mm, &b = before.back().translation_mm;
    bend_mm_ = std::max(bend_mm_, (a - 2 * b + now).norm() / 8);
  }

  const Joint& joint_;
  const motion::Motion& motion_;
  const FollowLoad& follow_;
  Vec3 last_mm_;
  double bend_mm_ = 0;
  std::string ended_by_;
};

/// The largest difference of another angle from where motions hold it.
double most_apart_deg(const motion::Motion& motion, const FollowRecord& record) {
  double most = 0;
  for (const JointCoordinates& frame : record.frames)
    for (const JointAngle angle : all_joint_angles)
      if (angle != motion.vary)
        most = std::max(most,
                        std::abs((angle_of(frame.angles, angle) - angle_of(motion.start, angle)).degrees()));
  return most;
}

/// Answers one motion after another.
class FollowingLimits {
 public:
  FollowingLimits(const Case& of, const RangeRequest& request, const Control& control)
      : joint_(of.joint),
        reference_mm_(of.placement.reference_pose.translation_mm),
        request_(request),
        control_(control),
        range_(joint_, request.range.bearing) {}

  /// Empty if stopped.
  std::optional<motion::MotionLimit> limit(const motion::Motion& motion) {
    auto limit = std::visit([&](const auto& follow) { return along(motion, follow); }, *request_.follow);
    ++done_;
    report(Angle(), motion);
    return limit;
  }

  const motion::FollowedRange& range() const noexcept { return range_; }
  const std::vector<RangeNote>& notes() const noexcept { return notes_; }
  double bend_mm() const noexcept { return bend_mm_; }

 private:
  std::optional<motion::MotionLimit> along(const motion::Motion& motion, const FollowRecord& record) {
    const Knots knots = from_start(recorded_translation(motion, record).knots);
    const auto next = [&](std::span<const motion::TranslationKnot> before) {
      if (!before.empty()) report(before.back().turned, motion);
      return before.size() < knots.size() ? std::optional(knots[before.size()]) : std::nullopt;
    };
    auto found = range_.limit(motion, next, control_.stop);
    if (!found) return std::nullopt;
    if (ended_early(found->limit, motion))
      note_end(found->limit, formatted("the recorded motion ends %.4g degrees past its start",
                                       found->limit.end.turned.degrees()));
    return std::move(found->limit);
  }

  std::optional<motion::MotionLimit> along(const motion::Motion& motion, const FollowLoad& load) {
    BalancedTranslation balanced(joint_, motion, load, reference_mm_);
    const auto next = [&](std::span<const motion::TranslationKnot> before) {
      if (!before.empty()) report(before.back().turned, motion);
      return balanced.next(before);
    };
    auto found = range_.limit(motion, next, control_.stop);
    if (!found) return std::nullopt;
    bend_mm_ = std::max(bend_mm_, balanced.bend_mm());
    if (ended_early(found->limit, motion)) note_end(found->limit, balanced.ended_by());
    return std::move(found->limit);
  }

  /// In thousandths of motions.
  void report(Angle turned, const motion::Motion& motion) const {
    constexpr std::size_t whole = 1000;
    if (!control_.progress) return;
    const double share = std::min(turned.radians() / motion.range.radians(), 1.0);
    control_.progress("thousandths of motions", whole * done_ + static_cast<std::size_t>(share * whole),
                      whole * request_.motions.size());
  }

  static bool ended_early(const motion::MotionLimit& limit, const motion::Motion& motion) noexcept {
    return limit.end.reason == motion::LimitReason::end_of_range && limit.end.turned < motion.range;
  }
  void note_end(motion::MotionLimit& limit, const std::string& why) {
    limit.translation_ends = true;
    notes_.push_back({RangeNoteCode::translation_ends, limit.motion.name + ": " + why});
  }

  const Joint& joint_;
  Vec3 reference_mm_;
  const RangeRequest& request_;
  const Control& control_;
  std::size_t done_ = 0;
  motion::FollowedRange range_;
  std::vector<RangeNote> notes_;
  double bend_mm_ = 0;
};

std::vector<std::string> caveats_of(const RangeRequest& request, double bend_mm) {
  constexpr auto bounded = "limits are bounded, not exact: the centre is not held";
  if (const auto* load = std::get_if<FollowLoad>(&*request.follow))
    return {formatted("the translation is where the contact carries the load, found every %g degrees and "
                      "taken to be straight in between, which is off by some %.2g mm; rotations are held; ",
                      load->step.degrees(), bend_mm) +
            bounded};
  double apart = 0;
  for (const motion::Motion& motion : request.motions)
    apart = std::max(apart, most_apart_deg(motion, std::get<FollowRecord>(*request.follow)));
  return {formatted("the translation is that of the recorded motion, straight between two of its frames, the "
                    "other angles are held, up to %.3g degrees from the recorded ones; ",
                    apart) +
          bounded};
}

}  // namespace

std::vector<motion::Motion> motions_recorded(std::span<const motion::Motion> motions,
                                             const FollowRecord& record) {
  std::vector<motion::Motion> recorded;
  for (const motion::Motion& motion : motions)
    if (recorded_translation(motion, record).why_none.empty()) recorded.push_back(motion);
  return recorded;
}

std::vector<motion::ContactNote> range_request_notes(const RangeRequest& request) {
  if (!request.follow) return {};
  if (const auto* record = std::get_if<FollowRecord>(&*request.follow)) return record->notes;
  const auto& load = std::get<FollowLoad>(*request.follow);
  std::vector<motion::ContactNote> notes = motion::check_layers(*load.layers, load.names);
  motion::add_new(notes, motion::check_load(load.load));
  return notes;
}

void answer::check_follow(const RangeRequest& request) {
  if (const auto* record = std::get_if<FollowRecord>(&*request.follow)) {
    for (const motion::Motion& motion : request.motions)
      if (const std::string why = recorded_translation(motion, *record).why_none; !why.empty())
        throw UsageError(motion.name + ": " + why);
    return;
  }
  const auto& load = std::get<FollowLoad>(*request.follow);
  if (!load.layers) throw UsageError("a translation follows a load through layers, and there are none");
  if (load.balance.free_rotations)
    throw UsageError("a translation that follows a load: rotations are held, for the motion turns the body");
  if (!(load.step > Angle() && load.step <= Angle::degrees(30)))
    throw UsageError("a translation that follows a load: its step must be above 0 and at most 30 degrees");
}

std::optional<RangeAnswer> answer::followed_range(const Case& of, const RangeRequest& request,
                                                  const Control& control) {
  RangeAnswer answer{.joint = of.joint, .follows = true, .contact_notes = range_request_notes(request)};
  answer.clock_plane = request.clock;
  FollowingLimits following(of, request, control);
  answer.bearing = following.range().bearing();
  answer.bearing_rule = following.range().bearing_rule();
  for (const motion::Motion& motion : request.motions) {
    auto limit = following.limit(motion);
    if (!limit) return std::nullopt;
    answer.limits.push_back(std::move(*limit));
  }
  // Limits about other centres say nothing where the centre moves.
  motion::BearingFinding without_socket = answer.bearing;
  if (without_socket.surface) without_socket.surface->socket.reset();
  answer.notes = range_notes(of.joint, answer.limits, request.range, without_socket);
  answer.notes.insert(answer.notes.end(), following.notes().begin(), following.notes().end());
  answer.caveats = caveats_of(request, following.bend_mm());
  return answer;
}

}  // namespace condyle
