#pragma once

#include <memory>
#include <optional>
#include <span>
#include <stop_token>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "condyle/answer/case.hpp"
#include "condyle/bearing.hpp"
#include "condyle/impingement_zone.hpp"
#include "condyle/implant.hpp"
#include "condyle/limit_band.hpp"
#include "condyle/motion_contact.hpp"
#include "condyle/motion_map.hpp"
#include "condyle/pressure.hpp"
#include "condyle/range_of_motion.hpp"

/// The range of motion: where each motion ends, with bands, maps and zones.

namespace condyle {

/// The translation of a free joint follows that of a recorded motion: along a motion that varies one angle, it is that of the frame
/// with this angle, linear between two frames.
struct FollowRecord {
  std::vector<JointCoordinates> frames = {};
  /// Warnings on the recorded numbers: the answer hands them on.
  std::vector<motion::ContactNote> notes = {};
};

/// The translation of a free joint follows a load: at each step it is where the contact of the layers carries the load, linear in
/// between.
struct FollowLoad {
  const contact::ElasticContact* layers = nullptr;  ///< outlives the request
  contact::Load load = {};
  contact::BalanceOptions balance = {};  ///< rotations are held
  Angle step = Angle::degrees(1);
  motion::BodyNames names = {};  ///< as notes call the bodies
};

using Follow = std::variant<FollowRecord, FollowLoad>;

/// The motions along which the recorded angle begins at the motion's start or before it, goes on past it, and never turns
/// back.
[[nodiscard]] std::vector<motion::Motion> motions_recorded(std::span<const motion::Motion> motions,
                                                           const FollowRecord& record);

/// Options of a request for the range of motion, with their defaults.
struct RangeRequest {
  std::vector<motion::Motion> motions = {};
  /// The reference pose of the overlap options is taken from the joint's placement.
  motion::RangeOptions range = {};
  /// A motion ends if the radial depth exceeds this, for meshes that overlap everywhere. Excludes maps, bands and
  /// zones.
  std::optional<motion::AllowedDepth> allowed_depth = {};
  /// The translation that a free joint keeps, mm, in the fixed body's axes; default: that of its reference pose.
  std::optional<Vec3> translation_mm = {};
  /// The centre of a free joint is not held but follows this. Limits are bounded then, not exact. Excludes a held translation, maps,
  /// bands, zones, an allowed depth and contacts that are left out.
  std::optional<Follow> follow = {};
  std::optional<motion::MapGrid> map = {};
  std::optional<BandRequest> bands = {};
  /// Impingement zones this far past each limit.
  std::optional<Angle> zones_past = {};
  /// The clock on which contacts are read.
  motion::ClockPlane clock = motion::ClockPlane::sagittal;
};

enum class RangeNoteCode : std::uint8_t {
  centre_moves_limits,  ///< Head and socket have different centres, and limits depend on which one the joint turns about.
  narrow_bearing_margin,  ///< Head and rim are too close for bearing contact to be distinguished from impingement.
  limit_on_cut,           ///< A motion ends on a face that closes a bone where its image ends: no limit.
  limit_on_part_cut,  ///< A motion ends on a face in which a part was cut from its body.
  limit_on_piece,     ///< Motions end on a piece of a body that holds neither head nor socket nor most of it.
  sliding_surfaces,   ///< Surfaces slide on each other by nature, and where they first touch a motion ends.
  translation_ends,   ///< The record or load of the translation ends before the motion's range.
  bones_touch,  ///< Head and socket are in contact over much of the bearing surface before anything turns.
  coarse_mesh,  ///< Triangles are so long that they cut off of head, neck or rim what moves limits by degrees.
  differs_from_closed_form,  ///< Meshes of an implant end a motion elsewhere than bodies of its sizes do.
  last_value_left_out,  ///< No whole number of steps leads to the last value of a map's axis: it ends before.
  nothing_holds_joint,  ///< A map translates the joint, and in this model nothing holds its bodies together but what they meet.
  limit_through_bone,  ///< A ligament runs straight through a body where it ends a motion.
};

/// As in files: "centre_moves_limits".
[[nodiscard]] std::string_view name_of(RangeNoteCode code) noexcept;

/// Caveat on the limits that follows from the shape of this joint. Unlike a JointNote it reports no fault of the
/// set-up.
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
  bool follows = false;                          ///< the centre is not held: limits are bounded, not exact
  std::vector<motion::MotionLimit> limits = {};  ///< one per motion
  std::vector<motion::DepthLimit> depths = {};   ///< one per motion if a depth is allowed, else none
  /// One per motion if liner and neck of an implant are bodies of revolution: where these two end it. Else none.
  std::vector<plan::ClosedLimit> closed = {};
  motion::BearingFinding bearing = {};  ///< what contacts are classified by
  motion::BearingRule bearing_rule = motion::BearingRule::count;
  motion::ClockFace clock = motion::sagittal_clock();
  motion::ClockPlane clock_plane = motion::ClockPlane::sagittal;
  std::vector<std::string> caveats = {};  ///< what was left out, accepted, allowed or held, a sentence each
  std::vector<RangeNote> notes = {};
  std::vector<std::optional<motion::ImpingementZone>> zones = {};  ///< one per motion if requested
  std::optional<motion::MotionMap> map = {};
  std::vector<motion::LimitBand> bands = {};            ///< one per motion if requested
  motion::BandOptions band_options = {};                ///< of the bands
  std::vector<motion::ContactNote> contact_notes = {};  ///< range_request_notes()
  /// The tables of the exact limits, for further questions about the joint; null with an allowed depth, and if the centre is not held.
  std::shared_ptr<const motion::RangeOfMotion> range = {};
};

/// The translation that all motions of a free joint keep: the one requested, else that of its reference pose. Empty for joints
/// that do not translate. Throws UsageError if one is requested of those, or if it would turn with the joint's axes.
[[nodiscard]] std::optional<Vec3> held_translation(const Case& joint, const std::optional<Vec3>& requested);

/// Throws UsageError as motion::check_grid(), and for a translation varied of a joint with ligaments that end motions: what they allow along it
/// is not computed.
void check_map(const motion::MapGrid& grid, const Joint& joint);

/// Throws UsageError for what answer_range() would refuse before it computes anything.
void check_range_request(const Case& joint, const RangeRequest& request);

/// Warnings on the recorded motion, or the layers and the load, that a translation follows: known before the work.
[[nodiscard]] std::vector<motion::ContactNote> range_request_notes(const RangeRequest& request);

/// Computes exact limits, or limits with a depth allowed, and what else is requested. Empty if it was stopped.
///
/// Throws UsageError for a request that contradicts itself or the joint, ReferenceContactError if the bodies are in contact in
/// the reference pose and the options do not say what to do about it, MeshError for a clock, zone or depth that the meshes do
/// not have.
///
/// Some milliseconds a motion, once the joint is prepared; maps and bands as motion_map() and limit_bands().
[[nodiscard]] std::optional<RangeAnswer> answer_range(const Case& joint, const RangeRequest& request,
                                                      const Control& control);
[[nodiscard]] RangeAnswer answer_range(const Case& joint, const RangeRequest& request);

/// The same by the tables of an answer about this joint with these options of the range: exact limits of further motions with their closed
/// forms, maps, bands and zones, and no notes on the limits. Empty if it was stopped. Throws UsageError as check_motion() and
/// check_grid().
[[nodiscard]] std::optional<RangeAnswer> further_answer(const Case& joint, const RangeAnswer& kept,
                                                        const RangeRequest& request,
                                                        const Control& control = {});

/// The notes of answer_range(), for callers who have the limits and their bearing surface already. Two searches of all motions if
/// head and socket are more than centres_apart_mm apart.
[[nodiscard]] std::vector<RangeNote> range_notes(const Joint& joint,
                                                 std::span<const motion::MotionLimit> limits,
                                                 const motion::RangeOptions& range,
                                                 const motion::BearingFinding& bearing);

/// Sentences on what these options leave out or accept.
[[nodiscard]] std::vector<std::string> range_caveats(const motion::RangeOptions& options,
                                                     const motion::RangeOfMotion& range);

}  // namespace condyle
