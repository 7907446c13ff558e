#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "condyle/bearing.hpp"
#include "condyle/clock_face.hpp"
#include "condyle/depth_limit.hpp"
#include "condyle/impingement_zone.hpp"
#include "condyle/joint.hpp"
#include "condyle/limit_band.hpp"
#include "condyle/make_joint.hpp"
#include "condyle/motion_map.hpp"
#include "condyle/range_of_motion.hpp"

/// One function per question: a request in, an owning result out. The command, the Python module, studies and reports all ask
/// here, so that they say the same bits, notes included.
///
///     RangeRequest request{.motions = hip_motions()};
///     const auto answer = answer_range(joint, placement, request);

namespace condyle {

/// How an answer's work is followed and ended.
struct AnswerControl {
  /// `stage` names what is counted, such as "map points": one call at a time, growing counts.
  std::function<void(std::string_view stage, std::size_t done, std::size_t total)> progress = {};
  std::stop_token stop = {};
};

/// What may be asked about the range of motion, with its defaults.
struct RangeRequest {
  std::vector<Motion> motions = {};
  /// The reference pose of the overlap options is taken from the joint's placement.
  RangeOptions range = {};
  /// A motion ends where the radial depth exceeds this, for meshes that overlap everywhere. Excludes maps, bands and zones.
  std::optional<AllowedDepth> allowed_depth = {};
  /// The translation that a free joint keeps, mm, in the fixed body's axes; default: that of its reference pose.
  std::optional<Vec3> translation_mm = {};
  std::optional<MapGrid> map = {};
  std::optional<BandOptions> bands = {};
  /// Impingement zones this far past each limit.
  std::optional<Angle> zones_past = {};
  /// The clock on which contacts are read.
  ClockPlane clock = ClockPlane::sagittal;
};

enum class RangeNoteCode : std::uint8_t {
  centre_moves_limits,  ///< Head and socket have different centres, and limits depend on which one the joint turns about.
  narrow_bearing_margin,  ///< Head and rim are too close for bearing contact to be distinguished from impingement.
};

/// As in files: "centre_moves_limits".
std::string_view name_of(RangeNoteCode code) noexcept;

/// What limits must be read with, because of the shape of this joint. Unlike a JointNote it says nothing against the set-up.
struct RangeNote {
  RangeNoteCode code;
  std::string text;  ///< one sentence
};

/// Head and socket farther apart than this, mm, make limits depend on the centre.
inline constexpr double centres_apart_mm = 1;

/// The limits of a joint, and everything that is said with them.
struct RangeAnswer {
  Joint joint;                                   ///< held at its translation
  std::optional<Vec3> held_translation_mm = {};  ///< of a free joint
  std::vector<MotionLimit> limits = {};          ///< one per motion
  std::vector<DepthLimit> depths = {};           ///< one per motion if a depth is allowed, else none
  BearingFinding bearing = {};                   ///< what contacts are classified by
  BearingRule bearing_rule = BearingRule::count;
  ClockFace clock = sagittal_clock();
  ClockPlane clock_plane = ClockPlane::sagittal;
  std::vector<std::string> caveats = {};  ///< what was left out, accepted, allowed or held, a sentence each
  std::vector<RangeNote> notes = {};
  std::vector<std::optional<ImpingementZone>> zones = {};  ///< one per motion if requested
  std::optional<MotionMap> map = {};
  std::vector<LimitBand> bands = {};  ///< one per motion if requested
  BandOptions band_options = {};      ///< as requested
};

/// The translation that all motions of a free joint keep: the one requested, else that of its reference pose. Empty for joints
/// that do not translate. Throws UsageError if one is requested of those, or if it would turn with the joint's axes.
std::optional<Vec3> held_translation(const Joint& joint, const JointPlacement& placement,
                                     const std::optional<Vec3>& requested);

/// Throws UsageError for what answer_range() would refuse before it computes anything.
void check_range_request(const Joint& joint, const JointPlacement& placement, const RangeRequest& request);

/// Computes exact limits, or limits with a depth allowed, and what else is requested. Empty if it was stopped.
///
/// Throws UsageError for a request that contradicts itself or the joint, ReferenceContactError if the bodies are in contact in
/// the reference pose and the options do not say what to do about it, MeshError for a clock, zone or depth that the meshes do
/// not have.
///
/// Some milliseconds a motion, once the joint is prepared; maps and bands as motion_map() and limit_bands().
std::optional<RangeAnswer> answer_range(const Joint& joint, const JointPlacement& placement,
                                        const RangeRequest& request, const AnswerControl& control);
RangeAnswer answer_range(const Joint& joint, const JointPlacement& placement, const RangeRequest& request);

/// The notes of answer_range(), for callers who have the bearing surface of the limits already. Two searches of all motions if
/// head and socket are more than centres_apart_mm apart.
std::vector<RangeNote> range_notes(const Joint& joint, std::span<const Motion> motions,
                                   const RangeOptions& range, const BearingFinding& bearing);

/// Sentences on what these options leave out or accept.
std::vector<std::string> range_caveats(const RangeOptions& options, const RangeOfMotion& range);

}  // namespace condyle
