#include <algorithm>
#include <span>
#include <utility>

#include "answer/foundation_caveat.hpp"
#include "condyle/answer.hpp"
#include "condyle/error.hpp"
#include "core/formatted.hpp"
#include "core/parallel.hpp"

namespace condyle {
namespace {

using Frames = std::vector<std::optional<Pose>>;

/// Whether the mobile body's origin is in one place in all frames.
bool holds_centre(const Frames& X_FM) {
  std::optional<Vec3> centre;
  return std::all_of(X_FM.begin(), X_FM.end(), [&](const std::optional<Pose>& X) {
    if (X && !centre) centre = X->translation();
    return !X || X->translation() == *centre;
  });
}

/// The load of each frame that has a pose to search for, and one for all if they share it. As in the swing of a gait, a frame
/// whose own load is zero has none: it is left out, and only it.
std::vector<contact::Load> loads_of(const MotionRequest& request, Frames& X_FM,
                                    std::vector<std::size_t>& without_load) {
  if (request.load) return {*request.load};
  std::vector<contact::Load> loads(X_FM.size());
  for (std::size_t i = 0; i < X_FM.size(); ++i) {
    if (!request.loads[i]) X_FM[i].reset();
    if (!X_FM[i]) continue;
    loads[i] = *request.loads[i];
    if (!contact::is_zero_along(loads[i], *X_FM[i], request.balance)) continue;
    without_load.push_back(i);
    X_FM[i].reset();
  }
  return loads;
}

/// Moves each frame to where the contact carries its load; frames that carry none become gaps. False if stopped.
bool balance_frames(const contact::ElasticContact& elastic, const MotionRequest& request, Frames& X_FM,
                    MotionAnswer& answer, const Control& control) {
  const std::vector<contact::Load> loads = loads_of(request, X_FM, answer.without_load);
  auto balanced = motion::balance_along(elastic, X_FM, loads, request.balance, control);
  if (!balanced) return false;
  answer.balanced = std::move(*balanced);
  answer.loads.resize(X_FM.size());
  for (std::size_t i = 0; i < X_FM.size(); ++i) {
    if (!X_FM[i]) continue;
    if (!answer.balanced[i]->carries_load()) {
      X_FM[i].reset();
      continue;
    }
    X_FM[i] = answer.balanced[i]->X_FM;
    const contact::Load& load = loads[loads.size() == 1 ? 0 : i];
    answer.loads[i] = load.on_mobile;
    if (load.frame == BodyRole::mobile) {
      const Eigen::Matrix3d R = X_FM[i]->linear();
      answer.loads[i] = {R * load.on_mobile.force_n, R * load.on_mobile.moment_nmm};
    }
  }
  return true;
}

/// contact_between() of each run of frames without a gap, a recording of its own. Empty if it was stopped.
std::optional<motion::RecordedContact> contact_between_frames(const contact::JointContact& bodies,
                                                              const Frames& X_FM,
                                                              std::span<const double> time_s,
                                                              const Control& control) {
  motion::RecordedContact all;
  for (std::size_t first = 0; first < X_FM.size();) {
    std::size_t last = first;
    std::vector<Pose> run;
    while (last < X_FM.size() && X_FM[last]) run.push_back(*X_FM[last++]);
    if (run.size() > 1) {
      auto found = motion::contact_between(bodies, time_s.subspan(first, run.size()), run, {}, control);
      if (!found) return std::nullopt;
      for (motion::ContactInterval& contact : found->contacts) {
        contact.entry.sample += first, contact.exit.sample += first;
        all.contacts.push_back(std::move(contact));
      }
      all.searched.insert(all.searched.end(), found->searched.begin(), found->searched.end());
      all.poses += found->poses;
    }
    first = last + 1;
  }
  return all;
}

bool is_between_searched(const MotionRequest& request, const Frames& X_FM) {
  switch (request.between) {
    case BetweenFrames::never:
      return false;
    case BetweenFrames::if_exact:
      return !request.has_load() && !request.time_s.empty() && holds_centre(X_FM);
    case BetweenFrames::always:
      return true;
  }
  return false;
}

/// The load with the largest force, which is the first to be unlikely.
std::optional<contact::Load> largest_load(const MotionRequest& request) {
  if (request.load) return request.load;
  std::optional<contact::Load> largest;
  for (const std::optional<contact::Load>& load : request.loads)
    if (load && (!largest || load->on_mobile.force_n.norm() > largest->on_mobile.force_n.norm()))
      largest = load;
  return largest;
}

/// Whether each frame that has a pose has a recorded motion, which a load would have made another.
bool are_recorded(const MotionRequest& request) {
  if (request.motions.empty() || request.has_load()) return false;
  for (std::size_t i = 0; i < request.X_FM.size(); ++i)
    if (request.X_FM[i] && !request.motions[i]) return false;
  return true;
}

SpeedsFrom speeds_from(const MotionRequest& request) {
  if (!has_damping(request.ligaments)) return SpeedsFrom::none;
  if (are_recorded(request)) return SpeedsFrom::recorded;
  return request.time_s.empty() ? SpeedsFrom::none : SpeedsFrom::frames;
}

std::vector<LigamentAlong> ligaments_of(const MotionRequest& request, SpeedsFrom from, const Frames& X_FM) {
  switch (from) {
    case SpeedsFrom::none:
      break;
    case SpeedsFrom::recorded:
      return ligaments_along(request.ligaments, X_FM, request.motions);
    case SpeedsFrom::frames:
      return ligaments_along(request.ligaments, X_FM, motions_along(X_FM, request.time_s));
  }
  return ligaments_along(request.ligaments, X_FM);
}

std::vector<std::optional<PoseStanding>> standings_of(
    const MotionRequest& request, const std::vector<std::optional<motion::FrameContact>>& frames) {
  const motion::RangeOfMotion& limits = *request.limits;
  std::vector<std::optional<PoseStanding>> standings(frames.size());
  core::parallel_chunks(frames.size(), 1, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i)
      if (const auto& frame = frames[i])
        standings[i] = pose_standing(limits, angles_at(limits.coordinates(), frame->X_FM),
                                     frame->X_FM.translation(), frame->in_contact, request.nearest_limits);
  });
  return standings;
}

void require_count(const char* what, std::size_t count, std::size_t frames) {
  if (count > 0 && count != frames)
    throw UsageError(core::formatted("%s: %zu for %zu frames", what, count, frames));
}

}  // namespace

std::string_view name_of(SpeedsFrom from) noexcept {
  constexpr std::string_view names[] = {"none", "recorded", "frames"};
  return names[static_cast<std::size_t>(from)];
}

void check_motion_request(const MotionRequest& request) {
  require_count("times", request.time_s.size(), request.X_FM.size());
  require_count("loads", request.loads.size(), request.X_FM.size());
  require_count("motions", request.motions.size(), request.X_FM.size());
  if (request.load && !request.loads.empty())
    throw UsageError("loads: one for all frames, or one for each, not both");
  for (const std::optional<contact::Load>& load : request.loads)
    check_load_request({.load = load, .balance = request.balance});
  check_load_request({.load = request.load, .balance = request.balance});
  if (request.between != BetweenFrames::always) return;
  if (request.time_s.empty())
    throw UsageError("between: needs times in seconds, and this motion has frame numbers only");
  if (request.has_load()) throw UsageError("between: is for poses as recorded, not for balanced ones");
}

std::vector<motion::ContactNote> motion_request_notes(const contact::ElasticContact* layers,
                                                      const MotionRequest& request) {
  std::vector<motion::ContactNote> notes;
  if (layers) notes = motion::check_layers(*layers, request.names);
  if (const auto load = largest_load(request)) motion::add_new(notes, motion::check_load(*load));
  return notes;
}

std::optional<MotionAnswer> answer_motion(const contact::JointContact& bodies,
                                          const contact::ElasticContact* layers, const MotionRequest& request,
                                          const Control& control) {
  check_motion_request(request);
  MotionAnswer answer{.notes = motion_request_notes(layers, request)};
  if (layers) answer.caveats.emplace_back(answer::foundation_caveat);

  Frames X_FM = request.X_FM;
  if (request.has_load()) {
    if (!layers) throw UsageError("load: needs layers that carry it");
    if (!balance_frames(*layers, request, X_FM, answer, control)) return std::nullopt;
  }
  if (is_between_searched(request, X_FM)) {
    answer.between = contact_between_frames(bodies, X_FM, request.time_s, control);
    if (!answer.between) return std::nullopt;
  }
  std::optional<contact::NormalDepth> depths;
  if (!layers) {
    const bool fixed_casts = request.casting == BodyRole::fixed;
    depths.emplace(fixed_casts ? bodies.fixed() : bodies.mobile(),
                   fixed_casts ? bodies.mobile() : bodies.fixed(), request.rays);
  }
  auto frames = motion::contact_along(
      bodies, layers ? motion::SurfaceQuestion(layers) : motion::SurfaceQuestion(&*depths), X_FM,
      request.casting, control);
  if (!frames) return std::nullopt;
  answer.frames = std::move(*frames);
  if (request.screws) {
    auto screws = motion::screws_along(bodies, answer.frames, control);
    if (!screws) return std::nullopt;
    answer.screws = std::move(*screws);
  }
  if (request.limits) answer.standings = standings_of(request, answer.frames);
  motion::add_new(answer.notes, motion::check_motion(answer.frames, request.names));
  answer.speeds_from = speeds_from(request);
  answer.ligaments = ligaments_of(request, answer.speeds_from, X_FM);
  motion::add_new(answer.notes, motion::check_ligaments(answer.ligaments, X_FM));
  if (layers)
    if (const auto largest = frame_of_largest_force(answer))
      if (const auto refined = layers->refined_force_n(answer.frames[*largest]->X_FM))
        answer.refined_largest_force_n = refined->norm();
  return answer;
}

MotionAnswer answer_motion(const contact::JointContact& bodies, const contact::ElasticContact* layers,
                           const MotionRequest& request) {
  return *answer_motion(bodies, layers, request, {});
}

std::optional<std::size_t> frame_of_largest_force(const MotionAnswer& answer) {
  std::optional<std::size_t> largest;
  double force = 0;
  for (std::size_t i = 0; i < answer.frames.size(); ++i) {
    if (!answer.frames[i] || !(answer.frames[i]->on_mobile.force_n.norm() > force)) continue;
    force = answer.frames[i]->on_mobile.force_n.norm();
    largest = i;
  }
  return largest;
}

}  // namespace condyle
