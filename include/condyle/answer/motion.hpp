#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "condyle/answer/case.hpp"
#include "condyle/control.hpp"
#include "condyle/joint.hpp"
#include "condyle/motion_contact.hpp"
#include "condyle/normal_depth.hpp"
#include "condyle/pressure.hpp"

/// Contact along a recorded motion.

namespace condyle {

/// Which contact between the samples of a motion is searched for.
enum class BetweenFrames : std::uint8_t {
  never,
  if_exact,  ///< If the mobile body's origin stays in one place, times are known and poses are as recorded: exact and cheap.
  always,    ///< Also if the origin moves: bounded. Needs times, and poses as recorded.
};

/// Where the speeds come from that ligaments are damped by.
enum class SpeedsFrom : std::uint8_t {
  none,      ///< No ligament has damping, or neither speeds nor times are known.
  recorded,  ///< MotionRequest::motions
  frames,    ///< motions_along(): times and poses of the frames, as balanced if a load was
};
/// As in files: "recorded".
[[nodiscard]] std::string_view name_of(SpeedsFrom from) noexcept;

/// Options of a request about a recorded motion, with their defaults.
struct MotionRequest {
  std::vector<std::optional<Pose>> X_FM = {};  ///< one per frame, empty for gaps
  std::vector<double> time_s = {};             ///< one per frame, or none if times are not known
  /// The mobile body is moved to the pose in which the contact carries this, the same in all frames; default: poses
  /// are as recorded.
  std::optional<contact::Load> load = {};
  /// The same with a load for each frame; an empty one makes its frame a gap, and a frame whose load is zero has no answer.
  std::vector<std::optional<contact::Load>> loads = {};
  contact::BalanceOptions balance = {};
  BetweenFrames between = BetweenFrames::if_exact;
  /// Without layers: which body's triangles cast, and how. An ElasticContact has its own.
  BodyRole casting = BodyRole::mobile;
  contact::NormalDepthOptions rays = {};
  motion::BodyNames names = {};  ///< as notes call the bodies
  std::vector<Ligament> ligaments = {};
  /// How the mobile body moves in each frame, if it was recorded. Only what ligaments damp needs it; it is used if every frame that has a pose has it
  /// too and no load moves the frames.
  std::vector<std::optional<RelativeMotion>> motions = {};
  const motion::RangeOfMotion* limits = nullptr;  ///< limits_of_poses(), which judge frames; null: none does
  /// Always: how far each frame is from the nearest limit, some 10 ms a frame.
  PoseStanding::FindNearest nearest_limits = PoseStanding::FindNearest::at_limits;

  bool screws = false;  ///< depths about the screw of the step into each frame: screws_along()

  [[nodiscard]] bool has_load() const noexcept { return load || !loads.empty(); }
};

/// Contact in every frame, and how a load was balanced.
struct MotionAnswer {
  std::vector<std::optional<motion::FrameContact>> frames = {};
  std::vector<std::optional<contact::BalancedPose>> balanced = {};  ///< none if no load was requested
  /// What the contact of each frame carries, on the mobile body, in F, about the origin of M; none if no load was requested.
  std::vector<std::optional<contact::Wrench>> loads = {};
  /// Frames whose own load is zero along what is free, ascending: no pose was searched for, and they have no answer.
  std::vector<std::size_t> without_load = {};
  /// Contact between the samples too; samples are numbered as the frames.
  std::optional<motion::RecordedContact> between = {};
  /// The force of the frame with the largest one, computed from the depth at 16 places of each face:
  /// ElasticContact::refined_force_n(). Empty without pressure.
  std::optional<double> refined_largest_force_n = {};
  std::vector<std::optional<PoseStanding>> standings = {};  ///< of the frames, if limits are given
  std::vector<LigamentAlong> ligaments = {};  ///< in the poses of the frames, balanced if a load was
  SpeedsFrom speeds_from = SpeedsFrom::none;
  std::vector<std::optional<motion::ScrewStep>> screws = {};  ///< if requested
  std::vector<motion::ContactNote> notes = {};  ///< what looks wrong with layers, loads and the motion
  std::vector<std::string> caveats = {};        ///< with pressure: what an elastic foundation leaves out
};

/// Throws UsageError for times, loads or motions that are not as many as frames, loads of both kinds, a moment without free rotations, or
/// BetweenFrames::always without times or with a load.
void check_motion_request(const MotionRequest& request);

/// Contact along a motion, with pressure if there are layers; empty if it was stopped. Stages: "balanced frames", "segments between
/// samples", "frames", "steps".
///
/// Throws UsageError as check_motion_request(), balance_along() and contact_between(), MeshError as contact_along().
[[nodiscard]] std::optional<MotionAnswer> answer_motion(const contact::JointContact& bodies,
                                                        const contact::ElasticContact* layers,
                                                        const MotionRequest& request, const Control& control);
[[nodiscard]] MotionAnswer answer_motion(const contact::JointContact& bodies,
                                         const contact::ElasticContact* layers, const MotionRequest& request);

/// The notes of answer_motion() on layers and loads, which are known before its work is done.
[[nodiscard]] std::vector<motion::ContactNote> motion_request_notes(const contact::ElasticContact* layers,
                                                                    const MotionRequest& request);

/// The frame with the largest force on the mobile body; empty if none is above 0.
[[nodiscard]] std::optional<std::size_t> frame_of_largest_force(const MotionAnswer& answer);

}  // namespace condyle
