#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "condyle/make_joint.hpp"

/// Checks of a joint: a side, axes, units or a centre that its meshes contradict, and meshes that do not allow every
/// query. docs/checks.md has the table.

namespace condyle {

enum class JointNoteCode : std::uint8_t {
  unlikely_size,      ///< No bone is so large or small, or its head is not.
  units_disagree,     ///< Head and socket have sizes of different units.
  open_mesh,          ///< It has no inside.
  inverted_mesh,      ///< Its volume is negative.
  self_crossings,     ///< Over more than a sliver of its surface.
  nested_surfaces,    ///< A piece lies inside another: a wall, a nucleus or a wide cavity.
  separate_pieces,    ///< A body is more than one piece.
  doubled_triangles,  ///< Closed, with triangles that lie on others: what they enclose counts twice.
  part_is_most,  ///< A part that is cut off the fixed body is more of it than the rest: normals that point inwards.
  pieces_left_out,      ///< Pieces of the label of a bone are not in its surface.
  gap_in_bone,          ///< Pieces that face each other across a gap are one bone; nothing fills the gap.
  interpolated_labels,  ///< Labels were interpolated and rounded: a bone lies in a shell of others.
  thick_slices,         ///< Voxels are too large to resolve the joint space.
  two_affines,          ///< The image's file places its voxels in two ways.
  two_voxel_sizes,      ///< ... and gives them two sizes.
  unknown_units,        ///< ... or no unit of length; mm was assumed.
  more_bytes,           ///< ... or holds more than its header promises.
  simplified_away,      ///< The surface moved by more than a voxel when it was simplified.
  touching,             ///< The voxels of both bones touch or overlap.
  cut_by_view,          ///< It ends where its image ends: what is missing may end a motion earlier.
  flat_end,             ///< It ends in a plane near the joint, as a bone that was cut for export: likewise.
  same_mesh,            ///< Both bodies are one mesh.
  swapped_bodies,       ///< The head is on the fixed body.
  unlikely_joint,       ///< A head in a socket, and another joint or a hinge stated.
  no_head,              ///< A hip without one: every contact ends a motion.
  head_not_round,       ///< A head that is longer one way: spacing lost, a gantry's tilt, or its shape.
  low_coverage,         ///< Little of a sphere or of a turn was there to fit.
  uncertain_fit,        ///< Parts of the surface give different centres or axes.
  far_centre,           ///< The bones of a knee, ankle or elbow are nearest each other far from it.
  centre_off_head,      ///< The joint centre is not that of the head.
  head_socket_apart,    ///< Head and socket have different centres, or a humeral head is beside its glenoid.
  socket_smaller_than_head,  ///< By their fitted radii.
  socket_larger_than_head,   ///< So much that the head is none of a bone: an implant's ball without its cup.
  axes_not_upright,          ///< Superior does not point up the bones.
  axes_turned,      ///< About superior: by 180 degrees, as where LPS is read as RAS, or a knee's by others.
  wrong_side,       ///< The hip bone lies lateral of its socket, or a femur is shaped as the other side's.
  mirrored,         ///< Only front and back are exchanged.
  bodies_disagree,  ///< The two bodies are of different sides.
  unlikely_version,  ///< The socket opens hardly in front of the neck: the bodies are in different frames, or retroverted.
  turned_leg,             ///< The femur of a hip does not lie in neutral where its angles are zero.
  ligament_off_bone,      ///< A ligament ends off its body, or nearer to the other one.
  ligament_through_bone,  ///< Its straight part runs through a body in the pose in which the meshes are given.
  unlikely_strain,        ///< A strain or slack length that no ligament has, as in per cent or another unit.
  mixed_orientation,      ///< Neighbours are wound differently: no inside, though there is no boundary.
  two_sided,  ///< Triangles that lie on others in the opposite sense: no inside if all do, else walls without thickness.
};

/// As in files: "wrong_side".
[[nodiscard]] std::string_view name_of(JointNoteCode code) noexcept;

/// Those that are of the image of a body, which its joint file keeps: `[[mobile.image.note]]`.
inline constexpr JointNoteCode image_note_codes[] = {
    JointNoteCode::pieces_left_out, JointNoteCode::gap_in_bone,     JointNoteCode::interpolated_labels,
    JointNoteCode::two_affines,     JointNoteCode::two_voxel_sizes, JointNoteCode::unknown_units,
    JointNoteCode::more_bytes,      JointNoteCode::simplified_away, JointNoteCode::touching};

/// The code of an image's note that a file calls so.
[[nodiscard]] std::optional<JointNoteCode> image_note_code(std::string_view name) noexcept;

/// A joint centre farther than this from that of the head, mm: limits change by 2 to 6 degrees with each millimetre.
inline constexpr double farthest_from_head_mm = 1;
/// Head and socket of the hips at hand are 1 mm apart: cartilage is thicker above than below.
inline constexpr double farthest_head_from_socket_mm = 1.5;

/// Looks at a joint as make_joint() placed it. Changes nothing and decides nothing: an answer stays what it is. Checks
/// that do not apply say nothing: most of those of anatomy are for hips, known by a ball joint with most of a head on the
/// mobile body, a shaft beyond it, and a socket round it on the fixed one. Shoulders have those of head and glenoid and
/// of the side, knees those of axes and side by the femur's condyles, long bones of other joints those that their shafts allow.
///
///           hip bone
///         |  mass: above and medial     ^ superior
///          \   of the socket            |
///           (  o )  opens forwards,     +--> lateral, front towards the reader
///             / \    outwards, down
///            neck: outwards, down
///
/// Searches both surfaces for spheres, which are kept with their meshes: some tens of milliseconds for 50,000 triangles, less
/// where a fit gave the centre.
[[nodiscard]] std::vector<JointNote> check_joint(const Joint& joint, const JointPlacement& placement);

/// Those of them that are about ligaments: ends off their bones, strings through bone, strains and slack lengths of other units. The pose in which
/// the mobile body is given decides, unless one body is inside the other there, as in models that count from elsewhere.
[[nodiscard]] std::vector<JointNote> check_ligaments(const Joint& joint, const JointPlacement& placement);

// From where the angles of a joint count, and how the femur of a hip lies there.

/// As in files: "as_given".
[[nodiscard]] std::string_view name_of(ZeroFrom from) noexcept;

/// A femur lies in neutral where its mechanical axis, from between its condyles to the head's centre, points superior, and the line behind both
/// condyles to the right: the axes of Wu et al. (2002) with the condyles' backs for the epicondyles, which lie 3 to 6 degrees
/// farther outwards. How far a scan may be from it unmentioned, in any angle: the axes of a pelvis, and condyles, are not known better.
inline constexpr double most_off_neutral_deg = 5;

/// What is known of the pose at which a joint's angles are zero.
struct ZeroPose {
  ZeroFrom from = ZeroFrom::as_given;
  /// The angles at which the femur of a hip lies there, by its condyles: all 0 in neutral. Empty without condyles, and for other joints.
  std::optional<JointAngles> femur = {};

  /// Whether the condyles say that zero is not neutral. Landmarks of both bodies are believed.
  [[nodiscard]] bool is_turned() const noexcept;
  /// Whether zero is neutral as far as anybody can know: only then limits are compared with those of other people.
  [[nodiscard]] bool is_neutral() const noexcept;
};

/// Some milliseconds per 100,000 triangles after the head is found; kept with the mesh.
[[nodiscard]] ZeroPose zero_pose(const Joint& joint);

/// "the pose in which femur is given; it shows no condyles, so how the leg lay is not known": where zero is.
[[nodiscard]] std::string zero_text(const Joint& joint, const ZeroPose& zero);

}  // namespace condyle
