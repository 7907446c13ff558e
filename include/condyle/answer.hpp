#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <stop_token>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "condyle/bearing.hpp"
#include "condyle/contact_measures.hpp"
#include "condyle/hip_measures.hpp"
#include "condyle/impingement_zone.hpp"
#include "condyle/implant.hpp"
#include "condyle/joint.hpp"
#include "condyle/limit_band.hpp"
#include "condyle/make_joint.hpp"
#include "condyle/motion_contact.hpp"
#include "condyle/motion_map.hpp"
#include "condyle/normal_depth.hpp"
#include "condyle/pressure.hpp"
#include "condyle/range_of_motion.hpp"
#include "condyle/resection.hpp"
#include "condyle/sweep.hpp"

/// One function per question: a request in, an owning result out. The command, the Python module, studies, reports and the page
/// all ask here, so that they say the same bits, notes included.
///
///     const auto depth = answer_depth(joint, {.X_FM = X_FM});
///     const auto range = answer_range(joint, placement, {.motions = hip_motions()});
///     const auto load  = answer_load(cartilages, {.X_FM = X_FM, .load = stance});
///     const auto gait  = answer_motion(bodies, &cartilages, {.X_FM = frames, .time_s = times});
///     const auto shape = answer_measures(hip);
///     const auto cup   = answer_implant(hip, placement, {.hip = {.head_radius_mm = 18}});

namespace condyle {

/// How the progress of an answer, which may have several stages, is reported and the work stopped: a Control that
/// names its stage.
struct AnswerControl {
  /// `stage` names what is counted, such as "map points": one call at a time, growing counts.
  std::function<void(std::string_view stage, std::size_t done, std::size_t total)> progress = {};
  std::stop_token stop = {};
};

// ---- one pose ------------------------------------------------------------------------------------------------------------

enum class DepthMethod : std::uint8_t {
  reliable,  ///< Along rays from the centre if that is a depth, else along the arc that frees a vertex soonest.
  radial,    ///< Along rays only.
  tangential,  ///< Along arcs about one axis of the joint.
  normal,      ///< Along normals of triangles, open meshes too.
};

/// Which measures an answer has beside its depths.
enum class MeasuresOf : std::uint8_t {
  contact,         ///< Areas, volume, centroids and nearest points too: most of the time of a deep pose.
  distances_only,  ///< Nearest distances of vertices; the other measures stay as they are made.
};

/// Options of a query at one pose, with their defaults.
struct DepthRequest {
  Pose X_FM = Pose::Identity();
  /// The angles that X_FM was made of, about whose axes arcs go; default: those that it has, which rounding may change.
  std::optional<JointAngles> pose = {};
  DepthMethod method = DepthMethod::reliable;
  /// With DepthMethod::tangential the angle about whose axis arcs go; default: flexion.
  std::optional<JointAngle> about = {};
  /// With DepthMethod::normal the body whose triangles cast, and how; defaults: both, NormalDepthOptions{}.
  std::optional<contact::Casting> casting = {};
  std::optional<contact::NormalDepthOptions> rays = {};
  contact::DistancesOf distances = contact::DistancesOf::vertices_inside;
  MeasuresOf measures = MeasuresOf::contact;
};

/// DepthMethod::reliable and radial: every vertex along its ray, and the depth to read of each. With `radial` that is its radial
/// depth, or its nearest distance if that is none.
struct RayDepths {
  contact::RadialContact contact;
  contact::ReliableContact reliable;
};

/// A rotation axis, by its joint angle and as a direction in F.
struct RotationAxis {
  JointAngle about;
  Vec3 direction_F;
};

/// DepthMethod::tangential: every vertex along its circle.
struct ArcDepths {
  RotationAxis axis;
  contact::TangentialContact contact;
};

struct DepthAnswer {
  DepthRequest request;
  contact::ContactMeasures measures;  ///< with DepthMethod::normal nearest distances and points only
  std::variant<RayDepths, ArcDepths, contact::NormalContact> depths;
  std::vector<std::string> caveats = {};  ///< what the depths must be read with, a sentence each

  bool in_contact() const noexcept;
};

/// Throws UsageError for options of another method, arcs at a pose that translates, and angles that are not those of X_FM.
void check_depth_request(const Joint& joint, const DepthRequest& request);

/// Depths at one pose. `bodies` are those of `joint`, and keep their tables for the next pose: the first call builds them, later
/// ones take some milliseconds in contact, arcs more.
///
/// Throws UsageError as check_depth_request(), MeshError as JointContact::radial() does. Open meshes have no inside: what lacks
/// an answer for that is empty.
DepthAnswer answer_depth(const contact::JointContact& bodies, const Joint& joint,
                         const DepthRequest& request);
DepthAnswer answer_depth(const Joint& joint, const DepthRequest& request);

// ---- a load in one pose --------------------------------------------------------------------------------------------------

/// Options of a query for the pressure of layers, with their defaults.
struct LoadRequest {
  Pose X_FM = Pose::Identity();
  /// The mobile body is moved from X_FM to the pose in which the contact carries this; default: it stays.
  std::optional<contact::Load> load = {};
  contact::BalanceOptions balance = {};
  motion::BodyNames names = {};  ///< as notes call the bodies
};

/// The pose requested, or the balanced one.
struct LoadAnswer {
  Pose X_FM = Pose::Identity();
  contact::ElasticContactResults contact = {};
  std::optional<contact::BalancedPose> balanced = {};  ///< if a load was requested
  std::size_t cut_off_by_reach = 0;                    ///< rays
  std::optional<Vec3> refined_force_n = {};            ///< ElasticContact::refined_force_n() at X_FM
  std::vector<motion::ContactNote> notes = {};         ///< what looks wrong with layers, load and contact
  std::vector<std::string> caveats = {};               ///< what an elastic foundation leaves out

  /// False if a load was requested and no contact carries it: `balanced` has the reason, X_FM and the contact are
  /// those at which the search stopped, and the numbers mean nothing.
  bool carries_load() const noexcept { return !balanced || balanced->carries_load(); }
};

/// Throws UsageError for a moment without free rotations, which nothing would balance.
void check_load_request(const LoadRequest& request);

/// Pressure at a pose, or at the pose that balances a load. Throws UsageError as check_load_request() and balance(), MeshError
/// as ElasticContact::at(). Costs two evaluations of the contact and sixteen rays for each triangle, and a balance ten more.
LoadAnswer answer_load(const contact::ElasticContact& surfaces, const LoadRequest& request);

// ---- a recorded motion ---------------------------------------------------------------------------------------------------

/// Which contact between the samples of a motion is searched for.
enum class BetweenFrames : std::uint8_t {
  never,
  if_exact,  ///< If the mobile body's origin stays in one place, times are known and poses are as recorded: exact and cheap.
  always,    ///< Also if the origin moves: bounded. Needs times, and poses as recorded.
};

/// Options of a query about a recorded motion, with their defaults.
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

  bool has_load() const noexcept { return load || !loads.empty(); }
};

/// Contact in every frame, and how a load was balanced.
struct MotionAnswer {
  std::vector<std::optional<motion::FrameContact>> frames = {};
  std::vector<std::optional<contact::BalancedPose>> balanced = {};  ///< none if no load was requested
  /// Frames whose own load is zero along what is free, ascending: no pose was searched for, and they have no answer.
  std::vector<std::size_t> without_load = {};
  /// Contact between the samples too; samples are numbered as the frames.
  std::optional<motion::RecordedContact> between = {};
  /// The force of the frame with the largest one, computed from the depth at 16 places of each face:
  /// ElasticContact::refined_force_n(). Empty without pressure.
  std::optional<double> refined_largest_force_n = {};
  std::vector<motion::ContactNote> notes = {};  ///< what looks wrong with layers, loads and the motion
  std::vector<std::string> caveats = {};        ///< with pressure: what an elastic foundation leaves out
};

/// Throws UsageError for times or loads that are not as many as frames, loads of both kinds, a moment without free rotations, or
/// BetweenFrames::always without times or with a load.
void check_motion_request(const MotionRequest& request);

/// Contact along a motion, with pressure if there are layers; empty if it was stopped. Stages: "balanced frames", "ways between samples", "frames".
///
/// Throws UsageError as check_motion_request(), balance_along() and contact_between(), MeshError as contact_along().
std::optional<MotionAnswer> answer_motion(const contact::JointContact& bodies,
                                          const contact::ElasticContact* layers, const MotionRequest& request,
                                          const AnswerControl& control);
MotionAnswer answer_motion(const contact::JointContact& bodies, const contact::ElasticContact* layers,
                           const MotionRequest& request);

/// The notes of answer_motion() on layers and loads, which are known before its work is done.
std::vector<motion::ContactNote> motion_request_notes(const contact::ElasticContact* layers,
                                                      const MotionRequest& request);

/// The frame with the largest force on the mobile body; empty if none is above 0.
std::optional<std::size_t> frame_of_largest_force(const MotionAnswer& answer);

// ---- the range of motion -------------------------------------------------------------------------------------------------

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
  const contact::ElasticContact* layers = nullptr;  ///< outlives the query
  contact::Load load = {};
  contact::BalanceOptions balance = {};  ///< rotations are held
  Angle step = Angle::degrees(1);
  motion::BodyNames names = {};  ///< as notes call the bodies
};

using Follow = std::variant<FollowRecord, FollowLoad>;

/// The motions along which the recorded angle begins at the motion's start or before it, goes on past it, and never turns
/// back.
std::vector<motion::Motion> motions_recorded(std::span<const motion::Motion> motions,
                                             const FollowRecord& record);

/// Options of a query for the range of motion, with their defaults.
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
  std::optional<motion::BandOptions> bands = {};
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
};

/// As in files: "centre_moves_limits".
std::string_view name_of(RangeNoteCode code) noexcept;

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
  motion::BandOptions band_options = {};                ///< as requested
  std::vector<motion::ContactNote> contact_notes = {};  ///< range_request_notes()
  /// The tables of the exact limits, for further questions about the joint; null with an allowed depth, and if the centre is not held.
  std::shared_ptr<const motion::RangeOfMotion> range = {};
};

/// The translation that all motions of a free joint keep: the one requested, else that of its reference pose. Empty for joints
/// that do not translate. Throws UsageError if one is requested of those, or if it would turn with the joint's axes.
std::optional<Vec3> held_translation(const Joint& joint, const JointPlacement& placement,
                                     const std::optional<Vec3>& requested);

/// Throws UsageError for what answer_range() would refuse before it computes anything.
void check_range_request(const Joint& joint, const JointPlacement& placement, const RangeRequest& request);

/// Warnings on the recorded motion, or the layers and the load, that a translation follows: known before the work.
std::vector<motion::ContactNote> range_request_notes(const RangeRequest& request);

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

/// Exact limits of further motions of a joint, with their closed forms, by the tables that its answer keeps: no notes, maps, bands or
/// zones. Empty if it was stopped. Throws UsageError as check_motion().
std::optional<RangeAnswer> further_limits(const RangeAnswer& kept, std::span<const motion::Motion> motions,
                                          const std::stop_token& stop = {});

/// The notes of answer_range(), for callers who have the limits and their bearing surface already. Two searches of all motions if
/// head and socket are more than centres_apart_mm apart.
std::vector<RangeNote> range_notes(const Joint& joint, std::span<const motion::MotionLimit> limits,
                                   const motion::RangeOptions& range, const motion::BearingFinding& bearing);

/// Sentences on what these options leave out or accept.
std::vector<std::string> range_caveats(const motion::RangeOptions& options,
                                       const motion::RangeOfMotion& range);

// ---- the shape of a hip --------------------------------------------------------------------------------------------------

/// Options of a query for the shape of a hip, with their defaults.
struct MeasureQuery {
  measure::MeasureRequest measures = {};
  std::optional<motion::BandOptions> bands = {};
};

/// The measures of a hip, and how far they are certain.
struct MeasureAnswer {
  measure::HipMeasures measures = {};
  /// In the order of measure_definitions() if requested, else none.
  std::vector<measure::MeasureBand> bands = {};
  motion::BandOptions band_options = {};  ///< as requested
};

/// Measures, and their bands if requested. Empty if it was stopped. Stage: "joints of the band".
///
/// Throws UsageError as measure_hip() and measure_bands() do, and costs what they cost.
std::optional<MeasureAnswer> answer_measures(const Joint& joint, const MeasureQuery& query,
                                             const AnswerControl& control);
MeasureAnswer answer_measures(const Joint& joint, const MeasureQuery& query = {});

// ---- the bone that must go -----------------------------------------------------------------------------------------------

/// Options of a query for a resection, with their defaults.
struct ResectionQuery {
  plan::ResectionRequest resection = {};
  /// Motions whose limits are given before and after; if empty, all motions of the joint.
  std::vector<motion::Motion> motions = {};
  /// The margin is as much larger as it takes that each target is reached in 95 % of displaced joints.
  std::optional<motion::BandOptions> bands = {};
  /// Points of each target's curve of degrees against removed volume; 0 for none.
  std::size_t curve_points = 10;
  /// How the shape of a hip is measured before and after.
  measure::MeasureRequest measures = {};
};

/// The cost of a target if it were the only one, at nearer angles.
struct ResectionCurvePoint {
  std::size_t target;
  Angle reached;
  double volume_mm3, deepest_mm;
};

enum class ResectionNoteCode : std::uint8_t {
  nothing_to_do,   ///< The joint reaches all targets uncut.
  target_blocked,  ///< Kept bone stops a motion short of its target.
  band_not_reached,  ///< Not reached in 95 % of displaced joints: the range of the motion or kept bone ends before.
  bearing_is_swept,  ///< The other bone sweeps over bearing surface, whose contact counts for nothing.
  neck_is_narrowed,  ///< More than 30 % of the neck's width goes.
  no_gain,           ///< A limit is unchanged.
  alpha_stays,  ///< The alpha angle is no smaller after a cut at the neck: what it is read from stands in no way.
  edge_changed,     ///< Triangles around the cut are larger or smaller than requested: EdgeReason.
  burr_meets_kept,  ///< The burr's ball would have to enter bone that stays.
  sliding_surfaces,  ///< The bodies slide on each other by nature, and no bearing surface is known: removed bone may belong to it.
  more_than_must,  ///< Much bone goes that no target needs: a depth, or counting whole triangles, cannot spare it.
  finer_triangles,  ///< A limit grows by the smaller triangles around a cut alone: fewer of them lie partly in the bearing ball.
};

/// As in files: "nothing_to_do".
std::string_view name_of(ResectionNoteCode code) noexcept;

struct ResectionNote {
  ResectionNoteCode code;
  std::string text;  ///< one sentence
};

/// Share of the neck's width that may go without a note.
inline constexpr double neck_width_share = 0.3;

struct ResectionAnswer {
  plan::Resection resection;
  double margin_mm = 0;  ///< as planned: larger than requested where a band is to be reached
  std::vector<motion::MotionLimit> before = {}, after = {};                 ///< one per motion
  std::optional<measure::HipMeasures> shape_before = {}, shape_after = {};  ///< of a hip
  std::vector<motion::LimitBand> bands = {};    ///< one per target if requested: after
  std::vector<ResectionCurvePoint> curve = {};  ///< by target, ascending
  std::vector<ResectionNote> notes = {};
  std::vector<std::string> caveats = {};  ///< what the plan leaves out, a sentence each
};

// ---- a total hip in a patient's joint -------------------------------------------------------------------------------------

/// Which sizes of a total hip are those of the bones it replaces, and not those of the request. They are rounded to hundredths of a degree or
/// a millimetre.
struct SizesOfBones {
  /// The angles of the line from the head's centre to where the axis of the neck passes that of the shaft nearest, so that the femur stays where
  /// it is; without a shaft those of the neck's axis, and the offset of the request.
  bool neck_shaft = true, stem_version = true, offset = true;
  bool cup_radius = true;  ///< the largest multiple of 0.5 mm that touches no bone
  bool cup = false;        ///< inclination and anteversion: those of the plane of the rim

  friend bool operator==(const SizesOfBones&, const SizesOfBones&) = default;
};

/// Placement of the centre of cup and head.
enum class ImplantCentre : std::uint8_t {
  head,    ///< the centre of the sphere that fits the head of the femur
  socket,  ///< that of the socket
};

/// As in files: "head".
std::string_view name_of(ImplantCentre centre) noexcept;
/// Throws UsageError that lists the valid words.
ImplantCentre implant_centre_named(std::string_view word);

/// Options of a query for an implant, with their defaults.
struct ImplantQuery {
  plan::TotalHip hip = {};
  SizesOfBones of_bones = {};
  ImplantCentre centre = ImplantCentre::head;
  /// How the bones are measured.
  measure::MeasureRequest measures = {};
};

enum class ImplantNoteCode : std::uint8_t {
  pelvis_as_scanned,  ///< The axes of the joint do not say how the pelvis lay, and the angles of the cup turn with it.
  centres_apart,  ///< Head and socket have different centres.
  centre_moved,   ///< The joint has another centre than the implant.
  no_shaft,  ///< The femur shows no shaft: the stem points down the frame's vertical, and the bone moves along it only.
  no_rim,          ///< How far the cup stands out of the bone is not known.
  cup_in_bone,     ///< The cup's outside lies in bone, which is not reamed.
  cup_stands_out,  ///< The cup's edge stands out of the rim in front by more than cup_stands_out_mm.
  trochanter_cut,  ///< The cut across the neck takes the tip of the greater trochanter too.
  meshes_left_out,  ///< Meshes called bearing or soft, such as cartilage, are not in the joint with the implant.
};

/// As in files: "cup_in_bone".
std::string_view name_of(ImplantNoteCode code) noexcept;

struct ImplantNote {
  ImplantNoteCode code;
  std::string text;  ///< one sentence
};

/// Where the edge of a cup stands out in front by more, mm, revision of the cup helped against pain of the psoas tendon more than cutting the
/// tendon did (Chalmers et al., J Bone Joint Surg Am 99, 2017).
inline constexpr double cup_stands_out_mm = 8;

/// By how much the edge of a cup stands out of the bone's rim, as an arc of the cup's outside, where it does so most.
struct CupOverhang {
  double mm;
  double hour;  ///< around the native socket: 12 superior, 3 anterior
};

/// A total hip in the place of a joint, and what it was placed by. Points and directions are in the frame of the joint that was given, at
/// zero angles; mm.
struct ImplantAnswer {
  plan::TotalHip hip;  ///< as it was placed
  SizesOfBones of_bones;
  ImplantCentre centre_of = ImplantCentre::head;
  Vec3 centre_mm;              ///< of cup and head: the origin of the new joint
  measure::HipMeasures bones;  ///< before
  std::optional<Sphere> socket = {};
  /// Uncertainty of the head's centre, if the joint was placed by a fit to it.
  std::optional<double> centre_bound_mm = {};
  double room_mm = 0;                          ///< from the centre to the nearest bone of the fixed body
  std::optional<CupOverhang> stands_out = {};  ///< empty if the edge stands out nowhere, or without a rim
  plan::NeckCut cut;                           ///< of the femur, in the frame of the new joint
  double removed_mm3 = 0;                      ///< of the femur
  Vec3 femur_shift_mm;                         ///< of the femur against the hip bone
  /// The new one: a ball about `centre_mm`, bones and implant. It has no parts with a pose of their own; the joint file has them.
  Joint joint;
  std::optional<RevolvedPair> pair = {};  ///< liner and neck, if they are bodies of revolution
  std::string why_no_pair = {};           ///< empty if there is a pair
  std::vector<ImplantNote> notes = {};
  std::vector<std::string> caveats = {};
};

/// A total hip in the place of the joint that a patient has: docs/placing-implants.md.
///
/// Throws UsageError for what is no hip, has an implant already or a shaft that lies level, for sizes as check_implant() does, for a head
/// that bone blocks, and if the bones do not show what a size is to be taken from, naming the size; MeshError for a femur that is
/// not closed or has no head; ReferenceContactError if the bodies are in contact at zero angles. As long as measure_hip().
ImplantAnswer answer_implant(const Joint& joint, const JointPlacement& placement, const ImplantQuery& query);

// ---- designs --------------------------------------------------------------------------------------------------------------

/// One of several parts of a sweep: whole lines of designs along the last parameter.
struct SweepShare {
  std::size_t number = 1, of = 1;
};

/// Further values of a design, computed from the joint at its values: shape, pressure.
struct SweepQuantities {
  std::vector<std::string> names;  ///< as columns have them, each with its unit at the end
  /// One for each name, NaN where there is none. May be called from any thread.
  std::function<std::vector<double>(const Joint&)> of;
};

/// Measures of a hip's shape, by their keys. Throws UsageError for a key that no measure has.
SweepQuantities measured_quantities(std::span<const std::string> keys,
                                    const measure::MeasureRequest& request);

/// Options of a query for a sweep, with their defaults.
struct SweepQuery {
  std::vector<plan::SweptParameter> parameters = {};  ///< one to four; the last one changes fastest
  std::vector<plan::SweepTarget> targets = {};        ///< one or more
  motion::RangeOptions range = {};
  /// The probability that a design leaves all targets free, over the standard deviations of parameters; the others of `sigma` are not used.
  std::optional<motion::BandOptions> bands = {};
  /// A joint is made anew for each design that has any: up to a second each.
  std::vector<SweepQuantities> quantities = {};
  SweepShare share = {};
};

enum class SweepNoteCode : std::uint8_t {
  differs_from_closed_form,  ///< Meshes of the implant do not have the limits of its sizes: every limit is searched for.
  nothing_is_safe,     ///< No design leaves every target free.
  everything_is_safe,  ///< All designs are safe.
  zone_leaves_window,  ///< Designs at the border of what was swept are safe: the zone goes on beyond.
  separate_intervals,  ///< Along some line the safe designs are not side by side.
  last_value_left_out,  ///< No whole number of steps leads to the last value of a parameter: the sweep ends before it.
  value_is_swept,  ///< A swept parameter has another value than the joint's description: it is that of the joint as it is only.
};

/// Those that are known before any design is: all shares of a sweep have them.
inline constexpr SweepNoteCode all_request_notes[] = {SweepNoteCode::differs_from_closed_form,
                                                      SweepNoteCode::last_value_left_out,
                                                      SweepNoteCode::value_is_swept};

/// As in files: "nothing_is_safe".
std::string_view name_of(SweepNoteCode code) noexcept;

struct SweepNote {
  SweepNoteCode code;
  std::string text;  ///< one sentence
};

/// The limits of all designs of a share, and where they are safe.
struct SweepAnswer {
  std::vector<plan::SweptParameter> parameters;
  std::vector<plan::SweepTarget> targets;
  std::vector<plan::EndingPair> pairs;
  SweepShare share;
  std::size_t first_design = 0;                ///< of the share
  std::vector<plan::DesignLimit> limits = {};  ///< of each design one per target
  /// One per design: the least of what its limits have over the targets' reach; safe where >= 0, NaN if in contact in its reference pose.
  std::vector<double> margin_deg = {};
  std::vector<double> probability = {};  ///< of each design if requested, 0 to 1
  std::vector<std::string> quantity_names = {};
  std::vector<double> quantities = {};  ///< of each design one per name; NaN where there is none
  std::vector<double> quantities_here = {};
  std::vector<plan::SafeInterval> safe = {};  ///< ascending by line and value
  /// Measures of what is safe, by the trapezoidal rule over the lines, and of the whole window; a share has its lines' part. In the product of
  /// the parameters' units.
  double safe_measure = 0, window_measure = 0;
  /// The design of the largest margin, the first of equals; empty if all are in contact.
  std::optional<std::size_t> best = {};
  std::vector<double> here = {};                    ///< the values that the joint has of the swept parameters
  std::vector<plan::DesignLimit> limits_here = {};  ///< one per target
  std::vector<SweepNote> notes = {};
  std::vector<std::string> caveats = {};

  std::size_t designs() const noexcept { return margin_deg.size(); }
  /// The values of a design, counted from the first of the whole sweep.
  std::vector<double> values_of(std::size_t design) const;
};

/// Designs of all axes together.
std::size_t designs_of(std::span<const plan::SweptParameter> parameters);

/// Throws UsageError for what answer_sweep() would refuse before it computes anything: no target or parameter, more than four of these,
/// values outside of a parameter's range, a reach beyond its motion's range, a tilt of what is no hip, a size.
void check_sweep(const Joint& joint, const SweepQuery& query);

/// Limits of every design of the share. Empty if it was stopped. Stages: "designs", "borders", "displaced designs",
/// "joints of designs".
///
/// Throws UsageError as check_sweep(), MeshError if nothing of a body could end a motion. Designs of an implant whose bones do not move cost
/// some microseconds a target; where the meshes decide, a millisecond a target and pair of meshes.
std::optional<SweepAnswer> answer_sweep(const Joint& joint, const JointPlacement& placement,
                                        const SweepQuery& query, const AnswerControl& control);
SweepAnswer answer_sweep(const Joint& joint, const JointPlacement& placement, const SweepQuery& query);

/// The shares of one sweep, all of them in their order, as one: the answer of the sweep that was not shared. Throws UsageError if one does not
/// follow the one before.
SweepAnswer merged_sweep(std::span<const SweepAnswer> shares);

// ---- the bone that must go, by words --------------------------------------------------------------------------------------

/// How far a motion shall go, by its name.
struct NamedReach {
  std::string motion;
  Angle reach;
};

/// Targets from "flexion=115 internal_rotation_at_90_flexion=30", separated by blanks or commas. Throws UsageError for other text.
std::vector<NamedReach> parse_reach(std::string_view text);

/// Targets of these motions, each by its name as motion_named() finds it. Throws UsageError for an unknown name.
std::vector<plan::ReachTarget> reach_targets(std::span<const motion::Motion> motions,
                                             std::span<const NamedReach> named);
/// The targets in a text, as parse_reach() reads it.
std::vector<plan::ReachTarget> reach_targets(std::span<const motion::Motion> motions, std::string_view text);

/// The bone that must go, the limits and the shape before and after, and what each degree costs. Empty if it was stopped. Stages:
/// "cuts", "joints of the band".
///
/// Throws as resect(), measure_hip() and limit_bands() do. A second for each cut of a hip of 20,000 triangles: one, one for each
/// point of a curve, and some for a band.
std::optional<ResectionAnswer> answer_resection(const Joint& joint, const JointPlacement& placement,
                                                const ResectionQuery& query, const AnswerControl& control);
ResectionAnswer answer_resection(const Joint& joint, const JointPlacement& placement,
                                 const ResectionQuery& query);

}  // namespace condyle
