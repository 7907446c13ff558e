#include "io/image/joint_bones.hpp"

#include <fmt/format.h>

#include "condyle/error.hpp"
#include "core/one_line.hpp"
#include "core/rounded.hpp"

namespace condyle::io {
namespace {

void add_notes(std::vector<LabelNote>& to, const std::vector<LabelNote>& notes) {
  to.insert(to.end(), notes.begin(), notes.end());
}

std::string spacing_text(const LabelSurface& surface) {
  const Vec3& h = surface.spacing;
  return fmt::format("{:.3g} x {:.3g} x {:.3g}", h.x(), h.y(), h.z());
}

bool same_grid(const VoxelGrid& a, const VoxelGrid& b) {
  return a.size == b.size && a.X_WI.matrix() == b.X_WI.matrix();
}

VoxelMask voxels_of(const ImagedBone& imaged) {
  return mask_of(imaged.map, imaged.bone.label);
}

/// Each label of a bone.
std::vector<ChosenLabel> labels_of(const ChosenLabel& bone) {
  std::vector<ChosenLabel> all{bone};
  all.insert(all.end(), bone.also.begin(), bone.also.end());
  return all;
}

}  // namespace

std::string label_numbers(const ChosenLabel& bone, std::string_view between) {
  std::string text;
  for (const ChosenLabel& each : labels_of(bone))
    text += fmt::format("{}{}", text.empty() ? "" : between, each.label);
  return text;
}

std::vector<std::string> origin_of(const LabelBone& bone, std::string_view image_name) {
  std::vector<std::string> lines;
  lines.push_back(fmt::format("label {} of {}, {} voxels of {} mm", label_numbers(bone.label, ", "),
                              core::one_line(image_name, 200), bone.voxels, spacing_text(bone.surface)));
  lines.push_back(
      fmt::format("surface off by about {:.2g} mm at most by the grid; by the segmentation, unknown",
                  bone.surface.digitisation));
  if (const auto& simplified = bone.surface.simplification)
    lines.push_back(fmt::format("simplified from {} triangles, within {:.2g} mm, which bands do not hold",
                                simplified->triangles_before, simplified->largest_error));
  return lines;
}

void check_are_two(const ImagedBone& fixed, const ImagedBone& mobile) {
  if (&fixed.map != &mobile.map) return;
  for (const ChosenLabel& a : labels_of(fixed.bone.label))
    for (const ChosenLabel& b : labels_of(mobile.bone.label))
      if (a.layer == b.layer && a.label == b.label)
        throw UsageError(fmt::format("{}: label {} is given for both bodies", fixed.file, a.label));
}

std::optional<Stated<Side>> stated_side(const std::optional<Side>& given, const LabelBone& fixed,
                                        const LabelBone& mobile, const std::string& given_by) {
  const auto of_fixed = side_in_name(fixed.name), of_mobile = side_in_name(mobile.name);
  if (of_fixed && of_mobile && *of_fixed != *of_mobile)
    throw UsageError(fmt::format("{} and {} are of two sides", fixed.name, mobile.name));
  const auto named = of_fixed ? of_fixed : of_mobile;
  if (given && named && *given != *named)
    throw UsageError(fmt::format("side: {} is given, and {} is of the other side", name_of(*given),
                                 of_fixed ? fixed.name : mobile.name));
  if (given) return Stated<Side>{*given, given_by};
  if (named) return Stated<Side>{*named, "by the names of the labels"};
  return std::nullopt;
}

std::vector<LabelNote> notes_on_touching(const ImagedBone& fixed, const ImagedBone& mobile) {
  if (!same_grid(fixed.map.grid, mobile.map.grid)) return {};
  const TouchingVoxels touching = touching_voxels(voxels_of(fixed), voxels_of(mobile));
  const std::string &of_fixed = fixed.bone.name, &of_mobile = mobile.bone.name;
  std::vector<LabelNote> notes;
  if (touching.shared > 0)
    notes.push_back({LabelNoteCode::touching, fmt::format("{} voxels are both {} and {}: the bones overlap",
                                                          touching.shared, of_fixed, of_mobile)});
  if (touching.faces > 0)
    notes.push_back(
        {LabelNoteCode::touching,
         fmt::format("{} and {} touch at {} faces of voxels, about {} mm: there the joint space is below "
                     "what voxels of {:.2g} mm resolve, and its width is the smoothing's",
                     of_fixed, of_mobile, touching.faces, core::rounded(*touching.centre, 1),
                     fixed.bone.surface.spacing.maxCoeff())});
  return notes;
}

std::vector<LabelNote> notes_of(const ImagedBone& fixed, const ImagedBone& mobile) {
  std::vector<LabelNote> notes = fixed.map.notes;
  if (&fixed.map != &mobile.map) add_notes(notes, mobile.map.notes);
  add_notes(notes, fixed.bone.notes);
  add_notes(notes, mobile.bone.notes);
  add_notes(notes, notes_on_touching(fixed, mobile));
  return notes;
}

}  // namespace condyle::io
