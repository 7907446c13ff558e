#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "condyle/answer/case.hpp"
#include "condyle/hip_measures.hpp"
#include "condyle/implant.hpp"

/// A total hip in the place of a joint.

namespace condyle {

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
[[nodiscard]] std::string_view name_of(ImplantCentre centre) noexcept;
/// Throws UsageError that lists the valid words.
[[nodiscard]] ImplantCentre implant_centre_named(std::string_view word);

/// Options of a request for an implant, with their defaults.
struct ImplantRequest {
  plan::TotalHip hip = {};
  SizesOfBones of_bones = {};
  ImplantCentre centre = ImplantCentre::head;
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
[[nodiscard]] std::string_view name_of(ImplantNoteCode code) noexcept;

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

/// A total hip in the place of the joint that a patient has: docs/implants.md.
///
/// Throws UsageError for what is no hip, has an implant already or a shaft that lies level, for sizes as check_implant() does, for a head
/// that bone blocks, and if the bones do not show what a size is to be taken from, naming the size; MeshError for a femur that is
/// not closed or has no head; ReferenceContactError if the bodies are in contact at zero angles. As long as measure_hip().
[[nodiscard]] ImplantAnswer answer_implant(const Case& joint, const ImplantRequest& request);

}  // namespace condyle
