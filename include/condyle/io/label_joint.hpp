#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "condyle/io/joint_file.hpp"
#include "condyle/io/label_file.hpp"
#include "condyle/label_surface.hpp"

/// Bones and joints from label maps. docs/label-maps.md.

namespace condyle {

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

/// What a body must know of the image of its surface.
BodyImage image_of(const VoxelGrid& grid, const LabelSurface& surface);

/// Fewer voxels, or a smaller box, are no bone.
inline constexpr std::int64_t fewest_bone_voxels = 500;
inline constexpr double smallest_bone_mm = 20;

/// The surface of one bone; empty if it was stopped. `file` is what errors call the image. Throws UsageError as choose_label() does,
/// MeshError for a label that is empty or too small for a bone.
std::optional<LabelBone> bone_of(const LabelMap& map, std::string_view file, const LabelBoneRequest& request,
                                 const Control& control);
LabelBone bone_of(const LabelMap& map, std::string_view file, const LabelBoneRequest& request);

/// The side that a label's name states, as "femur_left" does; empty if it states none, or both.
std::optional<Side> side_in_name(std::string_view name);

/// Two bones that make a joint.
struct LabelJointRequest {
  std::filesystem::path labels;                             ///< with both bones, or with the fixed one
  std::optional<std::filesystem::path> mobile_labels = {};  ///< with the mobile one, if it is another file
  LabelFileOptions file = {};
  LabelBoneRequest fixed, mobile;
  std::filesystem::path joint_file = {};  ///< where it is to lie; the meshes lie beside it
  std::optional<Side> side = {};  ///< default: that of the labels' names, else inferred from the bones
};

struct LabelJoint {
  LabelBone fixed, mobile;
  std::filesystem::path fixed_mesh,
      mobile_mesh;  ///< where the joint file expects the surfaces: NAME.ply beside it
  JointProposal proposal;
  std::vector<LabelNote> notes;  ///< of the images, of both bones and of where they touch
};

/// Reads the images, extracts both bones and proposes a joint file as propose_joint() does: the axes are the image's. Writes nothing.
/// Throws FileError, and what bone_of() throws; UsageError if both bones are one label or their names are of two sides.
std::optional<LabelJoint> propose_joint(const LabelJointRequest& request, const Control& control);
LabelJoint propose_joint(const LabelJointRequest& request);

/// The same of images that were read already; `mobile_map` is null if one has both bones. The request's files name them.
std::optional<LabelJoint> propose_joint(const LabelMap& map, const LabelMap* mobile_map,
                                        const LabelJointRequest& request, const Control& control);

}  // namespace condyle
