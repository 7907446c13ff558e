#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "condyle/load_balance.hpp"
#include "condyle/motion_contact.hpp"
#include "condyle/pressure.hpp"

/// Checks of materials, loads and motions: reports numbers that no tissue, implant or joint has, as when a unit or a
/// sign is wrong. docs/checks.md has the table, with the sources of the bounds.

namespace condyle {

enum class ContactNoteCode : std::uint8_t {
  unlikely_modulus,        ///< No tissue or implant is so soft or stiff.
  unlikely_poisson_ratio,  ///< Below 0, or so near to a half that it determines the stiffness by itself.
  unlikely_thickness,      ///< No cartilage or implant is so thin or thick.
  layer_on_bone,           ///< The layer is far thinner than the closed mesh that is to be its surface.
  unlikely_load,           ///< A force beyond ten body weights.
  deeper_than_layers,      ///< The bodies overlap by more than their layers are thick.
  large_strain,            ///< By a large part of it.
  oblique_peak,  ///< The largest depth or pressure comes from a ray that meets the other surface at a slant.
  unlikely_angle,        ///< A recorded angle beyond two whole turns.
  unlikely_translation,  ///< A recorded translation beyond a metre.
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
