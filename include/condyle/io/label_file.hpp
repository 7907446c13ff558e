#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "condyle/io/joint_file.hpp"
#include "condyle/label_surface.hpp"

/// Label maps: images in which the value of a voxel says which bone it belongs to. Every function that reads raises FileError,
/// one line "file: element: what is wrong", and nothing else, whatever the file holds. Bones and joints from them: docs/label-maps.md.

namespace condyle::io {

/// NIfTI-1 and -2 (.nii, .nii.gz, .hdr with .img), NRRD (.nrrd, .nhdr, .seg.nrrd), MetaImage (.mha, .mhd).
enum class LabelFormat { nifti, nrrd, metaimage };

/// A name that the file gives to one value in one layer. Two layers may have the same value: these are two segments.
struct LabelSegment {
  std::string name;  ///< without characters that a terminal obeys
  std::string id;    ///< of 3D Slicer; empty in other files
  std::size_t layer = 0;
  std::uint32_t label = 0;
};

/// A warning on a label map or on a choice among its labels. It changes nothing.
enum class LabelNoteCode {
  two_affines,         ///< NIfTI: sform and qform place the voxels differently.
  two_voxel_sizes,     ///< NIfTI: pixdim gives voxels another size than the sform.
  unknown_units,       ///< NIfTI: no unit of length; mm was assumed.
  more_bytes,          ///< The file holds more than its header promises.
  empty_segmentation,  ///< One voxel: 3D Slicer writes an empty segmentation so.
  pieces,              ///< A bone is in several pieces.
  cavities,            ///< It has closed cavities, such as marrow.
  cut_by_view,         ///< It reaches the border of its image.
  simplified_away,     ///< Its simplification moved the surface by more than a voxel.
  touching,            ///< Two bones touch or overlap.
  label_tables,        ///< A number was asked for: the names that published tables and the file give it.
  axes_not_used,       ///< Axes were stated, and the file has its own, which count.
  interpolated,        ///< Labels were interpolated and rounded: a bone lies in a shell of others.
};

/// As in files: "two_affines".
[[nodiscard]] std::string_view name_of(LabelNoteCode code) noexcept;

struct LabelNote {
  LabelNoteCode code;
  std::string text;  ///< one sentence
};

/// A label map, whatever its format was.
struct LabelMap {
  /// The world is always LPS in mm: x to the left, y to posterior, z to superior. NIfTI's world and those of NRRD's
  /// right-anterior-superior and left-anterior-superior are converted: x and y, or y only, change their sign.
  VoxelGrid grid;
  std::vector<std::uint32_t> labels;  ///< the distinct values of all voxels, ascending
  /// One per layer, at least one: the index into `labels` of each voxel, i runs fastest, then j, then k.
  std::vector<std::vector<std::uint16_t>> layers;
  std::vector<LabelSegment> segments;  ///< in the file's order; empty if it names nothing
  std::vector<LabelNote> notes;
};

/// Which affine of a NIfTI file counts: the sform, and the qform if there is none; or only one of both, without which the file
/// is refused.
enum class AffineChoice { sform_first, sform, qform };

/// Orientation that a user states for a file that has none. NRRD with axes but no named space: their world. Otherwise: the
/// directions in which i, j and k run, with voxel (0, 0, 0) at the origin if the file gives no other place.
enum class StatedAxes { lps, ras, las };

struct LabelFileOptions {
  AffineChoice affine = AffineChoice::sform_first;
  /// One volume among several of a NIfTI file, counted from 0; such a file is refused without it.
  std::optional<std::int64_t> volume = {};
  /// Counts only for a file without orientation, which is refused without it; of others a note.
  std::optional<StatedAxes> axes = {};
  /// Data may lie outside the folder of the header that names them.
  bool outside_folder = false;
};

/// Reads a label map; the extension decides on the format, in upper or lower case. Values must be whole numbers from 0 to
/// 2^32 - 1, at most 65535 different ones: floats within 1e-3 of a whole number count as that. The file is read piece by
/// piece: memory is 2 bytes for each voxel, and a fixed amount beside it.
///
/// Refused: axes in one plane, a size of 0, more than 2^40 voxels, fewer bytes than the header promises, and before any
/// memory is taken a compressed file that is too short for them.
[[nodiscard]] LabelMap read_labels(const std::filesystem::path& path, const LabelFileOptions& options = {});

/// The same from memory; `name` is what errors call the file. A header whose data lie in another file is refused.
[[nodiscard]] LabelMap read_labels(std::string_view bytes, LabelFormat format, std::string_view name,
                                   const LabelFileOptions& options = {});

/// The format that the name of a file ends in, nothing if it is none of a label map.
[[nodiscard]] std::optional<LabelFormat> label_format_of(const std::filesystem::path& path);

/// The voxels of a label in their smallest box. A label that no voxel of the layer has gives a box of size 0. The layer
/// must exist.
[[nodiscard]] VoxelMask mask_of(const LabelMap& map, std::size_t layer, std::uint32_t label);

struct ChosenLabel;
/// The voxels of all labels of a bone.
[[nodiscard]] VoxelMask mask_of(const LabelMap& map, const ChosenLabel& bone);

/// Extent of a label in one layer.
struct LabelSummary {
  std::size_t layer = 0;
  std::uint32_t label = 0;
  std::int64_t voxels = 0;
  std::array<std::int64_t, 3> first{};  ///< of the smallest box
  std::array<std::int64_t, 3> size{};   ///< of the smallest box
  /// Whether it reaches the first and the last voxels of the image along i, j and k: first i, last i, first j, ... The field
  /// of view may have cut it there.
  std::array<bool, 6> touches{};
};

/// Every label of every layer that has voxels, by layer and then by label; one pass over the image.
[[nodiscard]] std::vector<LabelSummary> summaries_of(const LabelMap& map);

/// Tables of labels that TotalSegmentator publishes: version 2 and 1 of its task for CT, and that for MR.
enum class LabelTask { total, total_v1, total_mr };

/// "total", "total_v1" or "total_mr", nothing for any other word.
[[nodiscard]] std::optional<LabelTask> label_task_of(std::string_view word) noexcept;
[[nodiscard]] std::string_view name_of(LabelTask task) noexcept;

/// One label among those of a file, as a user chose it.
struct ChosenLabel {
  std::size_t layer = 0;
  std::uint32_t label = 0;
  std::string name;                    ///< that of the file, else of the table, else empty
  std::vector<LabelNote> notes;        ///< a bare number: its names in the tables
  std::vector<ChosenLabel> also = {};  ///< other labels of the same bone
};

/// The label that a user means: a number ("75"); a layer and a number ("1:3") where several layers have that value; or a name
/// or id of a segment, or a name of the task's table: first exactly, then in any case with blanks as '_'. A name is never
/// guessed by likeness. Several with commas between them ("21,22") are one bone.
///
/// UsageError for a name that neither the file nor the table has, which lists the names there are; for one that stands for
/// several; for a number that no voxel has; and if the file and the table call one value differently. A segment without voxels
/// is found all the same: mask_of() gives it a size of 0.
[[nodiscard]] ChosenLabel choose_label(const LabelMap& map, std::string_view text,
                                       std::optional<LabelTask> task = {});

/// Which bone, and how its surface is made.
struct LabelBoneRequest {
  /// As choose_label() takes it. If empty, the only label above 0 that the image has, as in a mask of one bone.
  std::string label;
  std::optional<LabelTask> task = {};
  LabelSurfaceOptions surface = {};
};

/// A bone of a label map.
struct LabelBone {
  std::string name;  ///< of the label: "femur_right"; if it has none that of a mask's file, else "label_76"
  ChosenLabel label;
  std::int64_t voxels = 0;
  LabelSurface surface;  ///< in LPS, mm
  BodyImage image;       ///< for the body that is made of it
  std::vector<LabelNote> notes = {};
};

/// Facts about the image of a body's surface.
[[nodiscard]] BodyImage image_of(const VoxelGrid& grid, const LabelSurface& surface);

/// Fewer voxels, or a smaller box, are no bone.
inline constexpr std::int64_t fewest_bone_voxels = 500;
inline constexpr double smallest_bone_mm = 20;

/// The surface of one bone; empty if it was stopped. `file` is what errors call the image. Throws UsageError as choose_label() does,
/// MeshError for a label that is empty or too small for a bone.
[[nodiscard]] std::optional<LabelBone> bone_of(const LabelMap& map, std::string_view file,
                                               const LabelBoneRequest& request, const Control& control);
[[nodiscard]] LabelBone bone_of(const LabelMap& map, std::string_view file, const LabelBoneRequest& request);

/// The side that a label's name states, as "femur_left" does; empty if it states none, or both.
[[nodiscard]] std::optional<Side> side_in_name(std::string_view name);

/// Two bones that make a joint.
struct LabelJointRequest {
  std::filesystem::path labels;                             ///< with both bones, or with the fixed one
  std::optional<std::filesystem::path> mobile_labels = {};  ///< with the mobile one, if it is another file
  LabelFileOptions file = {};
  LabelBoneRequest fixed, mobile;
  std::filesystem::path joint_file = {};  ///< where it is to lie; the meshes lie beside it
  std::optional<Side> side = {};  ///< default: that of the labels' names, else inferred from the bones
  std::string side_by = "given";  ///< who states it, as the joint file says
};

struct LabelJoint {
  LabelBone fixed, mobile;
  std::filesystem::path fixed_mesh,
      mobile_mesh;  ///< where the joint file expects the surfaces: NAME.ply beside it
  JointProposal proposal;
  std::vector<LabelNote> notes;  ///< of the images, of both bones and of where they touch
};

/// Reads the images, extracts both bones and proposes a joint file as propose_joint() does: the axes are the image's. Writes nothing.
/// If a label has several large pieces, as both halves of a pelvis, the bone is the piece nearest to the other bone; if both labels
/// have, as of both femora, the mobile one is the piece on the side of the request.
/// Throws FileError, and what bone_of() throws; UsageError if both bones are one label or their names are of two sides.
[[nodiscard]] std::optional<LabelJoint> propose_joint(const LabelJointRequest& request,
                                                      const Control& control);
[[nodiscard]] LabelJoint propose_joint(const LabelJointRequest& request);

/// The same of images that were read already; `mobile_map` is null if one has both bones. The request's files name them.
[[nodiscard]] std::optional<LabelJoint> propose_joint(const LabelMap& map, const LabelMap* mobile_map,
                                                      const LabelJointRequest& request,
                                                      const Control& control);

}  // namespace condyle::io
