#include "condyle/io/label_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "condyle/error.hpp"
#include "core/one_line.hpp"
#include "core/rounded.hpp"
#include "io/joint/proposal.hpp"

namespace condyle {
namespace {

/// A name that every file system takes.
std::string file_name_of(std::string_view name) {
  std::string out;
  for (const char c : name) out += std::isalnum(static_cast<unsigned char>(c)) || c == '-' ? c : '_';
  return out + ".ply";
}

void add(std::vector<LabelNote>& to, const std::vector<LabelNote>& notes) {
  to.insert(to.end(), notes.begin(), notes.end());
}

std::string spacing_text(const LabelSurface& surface) {
  const Vec3& h = surface.spacing;
  return fmt::format("{:.3g} x {:.3g} x {:.3g}", h.x(), h.y(), h.z());
}

io::ProposedBody body_of(LabelBone& bone, const std::filesystem::path& mesh,
                         const std::filesystem::path& image) {
  io::ProposedBody body{bone.surface.mesh, mesh, bone.name, {}, bone.image};
  body.comments.push_back(fmt::format("label {} of {}, {} voxels of {} mm", bone.label.label,
                                      core::one_line(image.filename().string(), 200), bone.voxels,
                                      spacing_text(bone.surface)));
  body.comments.push_back(
      fmt::format("surface off by about {:.2g} mm at most by the grid; by the segmentation, unknown",
                  bone.surface.digitisation));
  if (const auto& simplified = bone.surface.simplification)
    body.comments.push_back(
        fmt::format("simplified from {} triangles, within {:.2g} mm, which bands do not hold",
                    simplified->triangles_before, simplified->largest_error));
  for (const LabelNote& note : bone.notes)
    body.comments.push_back(fmt::format("{}: {}", name_of(note.code), note.text));
  return body;
}

bool same_grid(const VoxelGrid& a, const VoxelGrid& b) {
  return a.size == b.size && a.X_WI.matrix() == b.X_WI.matrix();
}

/// Bones of one grid that are neighbours, voxel to voxel: labels of one image, or two masks that were cut out of it.
void note_touching(const LabelMap& fixed_map, const LabelBone& fixed, const LabelMap& mobile_map,
                   const LabelBone& mobile, std::vector<LabelNote>& notes) {
  if (!same_grid(fixed_map.grid, mobile_map.grid)) return;
  const TouchingVoxels touching =
      touching_voxels(mask_of(fixed_map, fixed.label.layer, fixed.label.label),
                      mask_of(mobile_map, mobile.label.layer, mobile.label.label));
  const double voxel = fixed.surface.spacing.maxCoeff();
  if (touching.shared > 0)
    notes.push_back({LabelNoteCode::touching, fmt::format("{} voxels are both {} and {}: the bones overlap",
                                                          touching.shared, fixed.name, mobile.name)});
  if (touching.faces > 0)
    notes.push_back(
        {LabelNoteCode::touching,
         fmt::format("{} and {} touch at {} faces of voxels, about {} mm: there the joint space is below "
                     "what voxels of {:.2g} mm resolve, and its width is the smoothing's",
                     fixed.name, mobile.name, touching.faces, core::rounded(*touching.centre, 1), voxel)});
}

/// The side that is stated, and by what; FileError if the two labels are of different sides.
std::optional<io::Stated<Side>> stated_side(const LabelJointRequest& request, const LabelBone& fixed,
                                            const LabelBone& mobile) {
  const auto of_fixed = side_in_name(fixed.name), of_mobile = side_in_name(mobile.name);
  if (of_fixed && of_mobile && *of_fixed != *of_mobile)
    throw UsageError(fmt::format("{} and {} are of two sides", fixed.name, mobile.name));
  const auto named = of_fixed ? of_fixed : of_mobile;
  if (request.side && named && *request.side != *named)
    throw UsageError(fmt::format("side: {} is given, and {} is of the other side", name_of(*request.side),
                                 of_fixed ? fixed.name : mobile.name));
  if (request.side) return io::Stated<Side>{*request.side, "given"};
  if (named) return io::Stated<Side>{*named, "by the names of the labels"};
  return std::nullopt;
}

}  // namespace

std::optional<LabelJoint> propose_joint(const LabelMap& map, const LabelMap* other,
                                        const LabelJointRequest& request, const Control& control) {
  const LabelMap& mobile_map = other ? *other : map;
  const std::filesystem::path& mobile_file = request.mobile_labels ? *request.mobile_labels : request.labels;

  auto fixed = bone_of(map, request.labels.string(), request.fixed, control);
  if (!fixed) return std::nullopt;
  auto mobile = bone_of(mobile_map, mobile_file.string(), request.mobile, control);
  if (!mobile) return std::nullopt;
  if (!other && fixed->label.layer == mobile->label.layer && fixed->label.label == mobile->label.label)
    throw UsageError(
        fmt::format("{}: label {} is given for both bodies", request.labels.string(), fixed->label.label));

  io::ProposalFacts facts{
      .joint_file = request.joint_file,
      .from = "bones of the label map " + core::one_line(request.labels.filename().string(), 200),
      .side = stated_side(request, *fixed, *mobile),
      .units = io::Stated<LengthUnit>{LengthUnit::millimetres, "of surfaces from label maps"},
      .axes_by = "surfaces from label maps are in LPS, by the image's header"};
  const std::filesystem::path folder = request.joint_file.parent_path();
  LabelJoint joint{std::move(*fixed), std::move(*mobile), {}, {}, {}, map.notes};
  joint.fixed_mesh = folder / file_name_of(joint.fixed.name);
  joint.mobile_mesh = folder / file_name_of(joint.mobile.name);
  if (joint.fixed_mesh == joint.mobile_mesh) {
    joint.fixed_mesh = folder / file_name_of("fixed_" + joint.fixed.name);
    joint.mobile_mesh = folder / file_name_of("mobile_" + joint.mobile.name);
  }
  if (other) add(joint.notes, other->notes);
  add(joint.notes, joint.fixed.notes);
  add(joint.notes, joint.mobile.notes);
  note_touching(map, joint.fixed, mobile_map, joint.mobile, joint.notes);
  joint.proposal = io::proposal_of(body_of(joint.fixed, joint.fixed_mesh, request.labels),
                                   body_of(joint.mobile, joint.mobile_mesh, mobile_file), facts);
  return joint;
}

std::optional<LabelJoint> propose_joint(const LabelJointRequest& request, const Control& control) {
  const LabelMap map = read_labels(request.labels, request.file);
  std::optional<LabelMap> other;
  if (request.mobile_labels) other = read_labels(*request.mobile_labels, request.file);
  return propose_joint(map, other ? &*other : nullptr, request, control);
}

LabelJoint propose_joint(const LabelJointRequest& request) {
  return *propose_joint(request, {});
}

}  // namespace condyle
