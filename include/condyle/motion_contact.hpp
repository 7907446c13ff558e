#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "condyle/contact.hpp"
#include "condyle/control.hpp"
#include "condyle/first_contact.hpp"
#include "condyle/normal_depth.hpp"
#include "condyle/pressure.hpp"

/// Contact in a recorded motion: in every frame, and between its samples too (docs/mathematics/06-range-of-motion.md).
///
///     const JointContact joint(femur, tibia);
///     const ElasticContact surfaces(femur, tibia, options);
///     const auto frames = contact_along(joint, &surfaces, X_FM);  // one entry per pose, empty if that is a gap

namespace condyle::motion {

/// Results requested of the surfaces: pressure and depths, or depths with one of the bodies casting.
using SurfaceQuestion = std::variant<const contact::ElasticContact*, const contact::NormalDepth*>;

/// Contact of one frame.
struct FrameContact {
  Pose X_FM;
  bool in_contact = false;             ///< the surfaces meet, or one body is inside the other
  std::size_t intersecting_pairs = 0;  ///< of triangles
  double smallest_gap_mm = 0;          ///< between the surfaces; 0 if they meet
  /// Results of the casting surface, in its body's frame: the mobile one's if both are cast.
  contact::SurfaceContact surface = {};
  contact::Wrench on_mobile = {};  ///< by the fixed body, in F, about the origin of M; with pressure only
  /// Rays that a longer reach would find in contact: NormalDepth::cut_off_by_reach(). That costs as much as the
  /// depths, so it is computed only if depths near the reach or their absence give reason to: the largest is beyond
  /// half of it, or no ray ends in contact though bodies meet or one is open. Else 0, as the depth does not go from
  /// below a half to beyond the whole of the reach from one ray to the next, steps of a surface aside.
  std::size_t cut_off_by_reach = 0;
};

/// `casting` is the body that casts in a NormalDepth, which does not know; it means nothing to an ElasticContact.
///
/// One entry per pose, empty for gaps; frames in parallel, with the same answers on any number of threads. The outer
/// optional is empty if the work was stopped before its end. Raises what ElasticContact::at() raises, with the
/// frame's number before the message.
[[nodiscard]] std::optional<std::vector<std::optional<FrameContact>>> contact_along(
    const contact::JointContact& joint, const SurfaceQuestion& surfaces,
    std::span<const std::optional<Pose>> X_FM, BodyRole casting = BodyRole::mobile,
    const Control& control = {});

/// A step that turns by less is a slide: one of 1 mm would be about an axis half a kilometre away.
inline constexpr double slide_below_deg = 1e-4;

/// The step into a frame as one screw motion, and how deep the bodies are in each other along arcs about its axis.
struct ScrewStep {
  Angle rotation;  ///< from 0 to half a turn
  /// In F: of unit length, in the sense of the rotation, and the point nearest to the origin of M. None of a slide, nor past 179
  /// degrees, where the sense would hang on rounding.
  std::optional<contact::AxisLine> axis = {};
  /// Largest angle and largest arc by which a rotation frees a vertex of either body, not always one vertex; 0 if none is inside.
  /// Empty without an axis, and if vertices are inside of which no rotation frees any.
  std::optional<Angle> depth = {};
  std::optional<double> depth_mm = {};

  [[nodiscard]] bool is_slide() const noexcept { return rotation.degrees() < slide_below_deg; }
};

/// For each frame that has a frame before it. Vertices of a body are held against the other one if that is closed; UsageError if
/// neither is. A frame in contact costs a ring table of each body, some 10 ms for 30,000 triangles. Empty if it was stopped.
[[nodiscard]] std::optional<std::vector<std::optional<ScrewStep>>> screws_along(
    const contact::JointContact& joint, std::span<const std::optional<FrameContact>> frames,
    const Control& control = {});

/// The poses that balance a load, frame after frame: rotations are the recorded ones, and each frame starts from its
/// translation as the last frame that carries its load has moved its own, and on as that changed between two balanced frames
/// next to each other. One load for all frames, or one for each. Frames that do not carry it say so in their outcome and hand
/// nothing on; gaps stay gaps. Not parallel.
[[nodiscard]] std::optional<std::vector<std::optional<contact::BalancedPose>>> balance_along(
    const contact::ElasticContact& surfaces, std::span<const std::optional<Pose>> X_FM,
    std::span<const contact::Load> loads, const contact::BalanceOptions& balance = {},
    const Control& control = {});

// Checks of materials, loads and motions: reports numbers that no tissue, implant or joint has, as when a unit or a
// sign is wrong. docs/checks.md has the table, with the sources of the bounds.

enum class ContactNoteCode : std::uint8_t {
  unlikely_modulus,         ///< No tissue or implant is so soft or stiff.
  unlikely_poisson_ratio,   ///< Below 0, or so near to a half that it determines the stiffness by itself.
  unlikely_thickness,       ///< No cartilage or implant is so thin or thick.
  thickness_beyond_bounds,  ///< A measured thickness is beyond the bounds that its file gives.
  layer_on_bone,            ///< The layer is far thinner than the closed mesh that is to be its surface.
  unlikely_load,            ///< A force beyond ten body weights.
  deeper_than_layers,       ///< The bodies overlap by more than their layers are thick.
  large_strain,             ///< By a large part of it.
  oblique_peak,  ///< The largest depth or pressure comes from a ray that meets the other surface at a slant.
  unlikely_angle,           ///< A recorded angle beyond two whole turns, or angles that look like radians.
  unlikely_times,           ///< Recorded times in seconds that look like milliseconds.
  unlikely_translation,     ///< A recorded translation beyond a metre.
  beyond_range,             ///< A recorded coordinate beyond the range that its model gives it.
  locked_coordinate,        ///< One that its model locks, recorded with other values.
  mostly_apart,             ///< The bodies are far from each other in most frames.
  mostly_deep,              ///< They are far within each other in most frames.
  unknown_ligament_length,  ///< A ligament meets an ellipsoid, or an end of it is inside what it wraps.
  unlikely_strain,          ///< A ligament is strained by more than any bears.
};

/// As in files: "unlikely_modulus".
[[nodiscard]] std::string_view name_of(ContactNoteCode code) noexcept;

struct ContactNote {
  ContactNoteCode code;
  std::string text;  ///< one sentence
};

/// Adds those whose code is not among the notes yet: a force that was noted as a load is not noted again as the contact's.
void add_new(std::vector<ContactNote>& notes, std::vector<ContactNote> more);

/// Names of the bodies in sentences.
struct BodyNames {
  std::string_view fixed = "the fixed body", mobile = "the mobile body";
};

/// Looks at moduli, Poisson's ratios, thicknesses, and whether a layer's mesh is rather a bone. Changes nothing.
[[nodiscard]] std::vector<ContactNote> check_layers(const Mesh& fixed, const Mesh& mobile,
                                                    const contact::ElasticContactOptions& options,
                                                    const BodyNames& names = {});
[[nodiscard]] std::vector<ContactNote> check_layers(const contact::ElasticContact& contact,
                                                    const BodyNames& names = {});

/// Looks at the force that is to be balanced.
[[nodiscard]] std::vector<ContactNote> check_load(const contact::Load& load);

/// Looks at what one pose shows: force, strain of the layers, and what the largest values come from. Without layers the last only.
[[nodiscard]] std::vector<ContactNote> check_contact(const contact::ElasticContactResults& results,
                                                     const BodyNames& names = {});

/// Looks at the force and the strain of the layers in what a simulator integrates.
[[nodiscard]] std::vector<ContactNote> check_contact(const contact::ContactForces& forces);

/// Checks the frames of a motion, one note for all: strain, force, the source of the peaks, and the distance of the
/// bodies in most frames that have an answer.
[[nodiscard]] std::vector<ContactNote> check_motion(std::span<const std::optional<FrameContact>> frames,
                                                    const BodyNames& names = {});

/// Names ligaments without a length, and with a strain of more than a half, in some of these poses: ligaments_along() of them.
[[nodiscard]] std::vector<ContactNote> check_ligaments(std::span<const LigamentAlong> ligaments,
                                                       std::span<const std::optional<Pose>> X_FM);

/// Looks at the largest size of a recorded coordinate: an angle in degrees or a length in mm.
enum class RecordedKind : std::uint8_t { angle_deg, length_mm };
[[nodiscard]] std::optional<ContactNote> check_recorded(std::string_view coordinate, RecordedKind kind,
                                                        double largest);

/// Looks at all angles that a file's header says to be in degrees, each a column in degrees: the values of a motion in radians do
/// not reach 180 degrees, and no column moves by more than that.
[[nodiscard]] std::optional<ContactNote> check_degrees(std::span<const std::vector<double>> columns);

/// Looks at the times of all frames, in seconds and ascending.
[[nodiscard]] std::optional<ContactNote> check_times(std::span<const double> seconds);

/// How contact was searched for between two neighbouring samples.
enum class BetweenSamples : std::uint8_t {
  exact,    ///< The mobile body rotates about its held origin: closed form, no contact missed, however short.
  bounded,  ///< Its origin moves: free where no point can come far enough to make contact, and only there.
};

/// How one end of a contact is known.
enum class ContactEndKind : std::uint8_t {
  exact,      ///< from the closed form
  bounded,    ///< between a free moment and one in contact, both certain
  recording,  ///< The recording begins or ends before it.
};

/// Where a contact begins or ends.
struct ContactEnd {
  ContactEndKind kind = ContactEndKind::exact;
  double time_s = 0;
  /// Contact begins at time_s or later by at most this, and ends at time_s or earlier by at most this. Where contact is
  /// only possible, up to its other end.
  double uncertainty_s = 0;
  std::size_t sample = 0;  ///< between `sample` and the next one
  Angle turned = {};       ///< by the mobile body since that sample, about the axis of the segment, >= 0
  /// Features that meet there; from a bound two faces that cross at the nearest moment known to be in contact. Empty
  /// where one body is inside the other and their surfaces do not meet, and where contact is only possible.
  std::optional<ContactWitness> contact = {};
};

/// From entry to exit the bodies are in contact, but for what is undecided; before and after they are free for
/// certain.
struct ContactInterval {
  ContactEnd entry, exit;
  /// Whether they are in contact for certain at some moment: otherwise the surfaces pass so near to each other that
  /// neither contact nor its absence was shown within the resolution.
  bool is_certain = false;
  /// How much of it was shown neither to be in contact nor free; 0 from the closed form.
  double undecided_s = 0;
};

/// Contact in a whole recording: free outside the intervals, between the samples too.
struct RecordedContact {
  std::vector<ContactInterval> contacts;  ///< ascending and apart
  std::vector<BetweenSamples> searched;   ///< by the sample that a segment begins at; one fewer than samples
  std::size_t poses = 0;                  ///< evaluated if bounded
};

struct RecordedContactOptions {
  /// Where a bound decides: what is still undecided in pieces shorter than this stays so, and what is free for less
  /// between contacts counts as undecided. A point at 1 m/s moves by 0.01 mm in the default. Smaller costs a few more
  /// poses at each end of a contact, and many more where surfaces touch and slide along each other.
  double resolution_s = 1e-5;
};

/// When the bodies are in contact in a motion recorded as poses X_FM at times, s.
///
///     sample 11              12              13              14       contact of 2 ms between two samples 33 ms apart
///       o---------------------o-----[=]-------o---------------o       is found as one of a second is
///
/// Between two neighbouring samples the mobile body moves along one screw motion. If both have the same translation
/// that is a rotation about M's origin, which is the joint centre: entry and exit are the angles of FirstContact, in
/// closed form, with its error bound; free moments of less than 1e-9 rad between contacts count as contact.
/// Translations that differ by no more than placing a point rounds (4 * 2^-53 of its size) are the same. If the
/// translation changes there is no closed form: a segment is then called free only if that is proven, and an end of
/// contact lies between two moments whose state is certain.
///
/// Contact is that of JointContact::in_contact(): surfaces that meet, or one body inside the other if that one is
/// closed. On a hip of 30,000 and 15,000 triangles some 0.6 ms for a segment about a held centre, and 1 ms for each
/// pose that a bound evaluates: one if a segment is clearly free, dozens if contact begins or ends.
///
/// The same bits whatever the threads. Throws UsageError for fewer than two samples, not as many times as poses,
/// times that are not finite or do not ascend, poses that are not rotations to 1e-9 with a finite translation,
/// neighbours more than 179 degrees apart (the sense of rotation is not known), or a resolution that is not above 0;
/// the first bad sample is named, counted from 0.
[[nodiscard]] RecordedContact contact_between(const contact::JointContact& bodies,
                                              std::span<const double> time_s, std::span<const Pose> X_FM,
                                              const RecordedContactOptions& options = {});
/// The same; empty if it was stopped before all ways were done.
[[nodiscard]] std::optional<RecordedContact> contact_between(const contact::JointContact& bodies,
                                                             std::span<const double> time_s,
                                                             std::span<const Pose> X_FM,
                                                             const RecordedContactOptions& options,
                                                             const Control& control);

}  // namespace condyle::motion
