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
#include "condyle/normal_depth.hpp"
#include "condyle/pressure.hpp"

/// Contact in every frame of a recorded motion.
///
///     const JointContact joint(femur, tibia);
///     const ElasticContact surfaces(femur, tibia, options);
///     const auto frames = contact_along(joint, &surfaces, X_FM);  // one entry per pose, empty if that is a gap

namespace condyle {

/// Results requested of the surfaces: pressure and depths, or depths with one of the bodies casting.
using SurfaceQuestion = std::variant<const ElasticContact*, const NormalDepth*>;

/// Contact of one frame.
struct FrameContact {
  Pose X_FM;
  bool in_contact = false;             ///< the surfaces meet, or one body is inside the other
  std::size_t intersecting_pairs = 0;  ///< of triangles
  double smallest_gap_mm = 0;          ///< between the surfaces; 0 if they meet
  /// Results of the casting surface, in its body's frame: the mobile one's if both are cast.
  SurfaceContact surface = {};
  Wrench on_mobile = {};  ///< by the fixed body, in F, about the origin of M; with pressure only
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
std::optional<std::vector<std::optional<FrameContact>>> contact_along(
    const JointContact& joint, const SurfaceQuestion& surfaces, std::span<const std::optional<Pose>> X_FM,
    BodyRole casting = BodyRole::mobile, const Control& control = {});

/// The poses that balance a load, frame after frame: rotations are the recorded ones, and each frame starts from its
/// translation as the last frame that carries its load has moved its own, and on as that changed between two balanced frames
/// next to each other. One load for all frames, or one for each. Frames that do not carry it say so in their outcome and hand
/// nothing on; gaps stay gaps. Not parallel.
std::optional<std::vector<std::optional<BalancedPose>>> balance_along(
    const ElasticContact& surfaces, std::span<const std::optional<Pose>> X_FM, std::span<const Load> loads,
    const BalanceOptions& balance = {}, const Control& control = {});

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
  unlikely_angle,        ///< A recorded angle beyond two whole turns.
  unlikely_translation,  ///< A recorded translation beyond a metre.
  beyond_range,          ///< A recorded coordinate beyond the range that its model gives it.
  locked_coordinate,     ///< One that its model locks, recorded with other values.
  mostly_apart,          ///< The bodies are far from each other in most frames.
  mostly_deep,           ///< They are far within each other in most frames.
};

/// As in files: "unlikely_modulus".
std::string_view name_of(ContactNoteCode code) noexcept;

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
std::vector<ContactNote> check_layers(const Mesh& fixed, const Mesh& mobile,
                                      const ElasticContactOptions& options, const BodyNames& names = {});
std::vector<ContactNote> check_layers(const ElasticContact& contact, const BodyNames& names = {});

/// Looks at the force that is to be balanced.
std::vector<ContactNote> check_load(const Load& load);

/// Looks at what one pose shows: force, strain of the layers, and what the largest values come from. Without layers the last only.
std::vector<ContactNote> check_contact(const ElasticContactResults& results, const BodyNames& names = {});

/// Checks the frames of a motion, one note for all: strain, force, the source of the peaks, and the distance of the
/// bodies in most frames that have an answer.
std::vector<ContactNote> check_motion(std::span<const std::optional<FrameContact>> frames,
                                      const BodyNames& names = {});

/// Looks at the largest size of a recorded coordinate: an angle in degrees or a length in mm.
enum class RecordedKind : std::uint8_t { angle_deg, length_mm };
std::optional<ContactNote> check_recorded(std::string_view coordinate, RecordedKind kind, double largest);

}  // namespace condyle
