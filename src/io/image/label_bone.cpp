#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <utility>

#include "condyle/error.hpp"
#include "condyle/io/label_file.hpp"
#include "condyle/joint_checks.hpp"
#include "io/file/plain_text.hpp"
#include "io/image/joint_bones.hpp"
#include "kinematics/flat_ends.hpp"
#include "mesh/enclosed_volume.hpp"
#include "mesh/label_surface/voxel_pieces.hpp"

namespace condyle::io {
namespace {

/// Pieces below this share of the bone's voxels are specks, which are not reported.
constexpr double least_noted_piece = 1e-3;

/// The only label above 0; UsageError if there are several.
std::string only_label(const LabelMap& map, std::string_view file) {
  std::optional<LabelSummary> only;
  for (const LabelSummary& summary : summaries_of(map)) {
    if (summary.label == 0) continue;
    if (only)
      throw UsageError(fmt::format("{}: has several labels: --label says which one is meant; {}", file,
                                   labels_there(map)));
    only = summary;
  }
  if (!only) throw MeshError(fmt::format("{}: no voxel has a label above 0", file));
  return map.layers.size() > 1 ? fmt::format("{}:{}", only->layer, only->label)
                               : fmt::format("{}", only->label);
}

/// Name of the bone of a mask file, "femur_left" for femur_left.nii.gz, as TotalSegmentator writes them.
std::string name_of_mask(std::string_view file) {
  const std::string name = io::plain_text(std::filesystem::path(file).filename().string());
  return name.substr(0, name.find('.'));
}

/// Without a number's note on tables where nobody chose the number.
ChosenLabel chosen_label(const LabelMap& map, std::string_view file, const LabelBoneRequest& request) {
  const bool is_only = request.label.empty();
  try {
    ChosenLabel chosen = choose_label(map, is_only ? only_label(map, file) : request.label, request.task);
    if (is_only) chosen.notes.clear();
    return chosen;
  } catch (const UsageError& error) {
    const std::string_view what = error.what();
    throw UsageError(what.starts_with(file) ? std::string(what) : fmt::format("{}: {}", file, what));
  }
}

/// The number that voxels without a label have in layers; one that none has if there are no such voxels.
std::uint16_t nothing(const LabelMap& map) {
  return map.labels.front() == 0 ? std::uint16_t{0} : std::uint16_t{65535};
}

void check_size(const VoxelMask& mask, std::int64_t voxels, std::string_view file, std::string_view name) {
  if (voxels == 0) throw MeshError(fmt::format("{}: {} has no voxel", file, name));
  double longest = 0;
  for (int i = 0; i < 3; ++i)
    longest = std::max(longest, static_cast<double>(mask.size[static_cast<std::size_t>(i)]) *
                                    mask.image.X_WI.linear().col(i).norm());
  if (voxels < fewest_bone_voxels || longest < smallest_bone_mm)
    throw MeshError(fmt::format("{}: {} has {} voxels and is {:.3g} mm long: no bone is so small", file, name,
                                voxels, longest));
}

/// `kept_for`: why this piece is kept, "the largest". The joint of the bone says what is left out, but for the bone of the other side.
void note_pieces(LabelBone& bone, std::string_view kept_for, bool chooses, double other_side_mm3) {
  double kept = 0, dropped = 0;
  std::size_t kept_pieces = 0, dropped_pieces = 0;
  for (const LabelPiece& piece : bone.surface.pieces) {
    if (static_cast<double>(piece.voxels) < least_noted_piece * static_cast<double>(bone.voxels)) continue;
    (piece.kept ? kept : dropped) += piece.volume;
    ++(piece.kept ? kept_pieces : dropped_pieces);
  }
  if (kept_pieces + dropped_pieces < 2) return;
  std::string text = fmt::format("{} is in {} pieces", bone.name, kept_pieces + dropped_pieces);
  if (dropped_pieces > 0)
    text += fmt::format(": {} is kept, {:.0f} mm3, and {:.0f} mm3 are left out", kept_for, kept, dropped);
  if (kept_pieces > 1)
    text += chooses ? fmt::format("{} {} pieces that face each other are one bone",
                                  dropped_pieces > 0 ? ";" : ":", kept_pieces)
                    : ", all of them kept";
  if (dropped > other_side_mm3 + least_noted_piece * kept)
    bone.image.notes.push_back({JointNoteCode::pieces_left_out, text});
  if (chooses && kept_pieces > 1)
    bone.image.notes.push_back(
        {JointNoteCode::gap_in_bone,
         fmt::format(
             "{} pieces of {} that face each other are taken together as one bone; what lies between them, "
             "cartilage or a fracture, is in no surface: a motion that ends there in life goes on here",
             kept_pieces, bone.name)});
  bone.notes.push_back({LabelNoteCode::pieces, std::move(text)});
}

void note_shells(LabelBone& bone, double share) {
  constexpr double largest_share =
      0.25;  // other bones and organs are thicker than a voxel: maps as they are segmented have 0.03
  if (share <= largest_share) return;
  std::string text = fmt::format(
      "{:.0f} % of the border of {} is against other labels that are one voxel thick, as where labels were "
      "interpolated and rounded: the bone lacks its outer voxels; resample labels to the nearest neighbour",
      100 * share, bone.name);
  bone.image.notes.push_back({JointNoteCode::interpolated_labels, text});
  bone.notes.push_back({LabelNoteCode::interpolated, std::move(text)});
}

void note_cavities(const LabelBone& bone, bool kept, std::vector<LabelNote>& notes) {
  const LabelCavities& cavities = bone.surface.cavities;
  if (cavities.count == 0) return;
  notes.push_back(
      {LabelNoteCode::cavities,
       fmt::format("{} has {} cavit{} of {:.0f} mm3 together, {}", bone.name, cavities.count,
                   cavities.count == 1 ? "y" : "ies", cavities.volume, kept ? "kept" : "filled")});
}

void note_cuts(const LabelBone& bone, std::vector<LabelNote>& notes) {
  for (const CapPlane& cap : bone.surface.caps)
    notes.push_back({LabelNoteCode::cut_by_view,
                     fmt::format("{} ends at the {} voxels of the image along {}, and is closed there by a "
                                 "flat face of {:.0f} mm2: limits of a joint with it are upper bounds",
                                 bone.name, cap.high ? "last" : "first", "ijk"[cap.axis], cap.area)});
}

void note_simplification(const LabelBone& bone, std::vector<LabelNote>& notes) {
  const auto& simplified = bone.surface.simplification;
  if (!simplified || !(simplified->largest_error > bone.surface.spacing.maxCoeff())) return;
  notes.push_back({LabelNoteCode::simplified_away,
                   fmt::format("{} was simplified from {} to {} triangles, which moved its surface by up to "
                               "{:.3g} mm, more than a voxel: ask for more triangles",
                               bone.name, simplified->triangles_before, bone.surface.mesh.triangles.size(),
                               simplified->largest_error)});
}

/// Where the large piece lies that is the bone, in LPS, and how a note calls it: "the one beside femur_left".
struct PieceWanted {
  Vec3 near_W;
  std::string words;
};

/// Beside the other bone of a joint.
PieceWanted beside(const LabelBone& other) {
  const BoundingBox bounds = mesh::bounds_of_vertices(other.surface.mesh);
  return {(bounds.low + bounds.high) / 2, fmt::format("the one beside {}", other.name)};
}

PieceWanted on_side(Side side, const LabelMap& map) {
  constexpr double outside_mm = 1e5;  // of every image
  return {map.grid.X_WI.translation() + Vec3(side == Side::left ? outside_mm : -outside_mm, 0, 0),
          fmt::format("the one on the {}", name_of(side))};
}

/// Takes what is not of the bone out of the mask.
mesh::KeptBone keep_bone(const PieceWanted* wanted, VoxelMask& mask) {
  mesh::VoxelBox box{mask.size, std::move(mask.inside)};
  const std::array<std::int64_t, 3>& first = mask.first;
  const Eigen::Affine3d X_WB =
      mask.image.X_WI * Eigen::Translation3d(static_cast<double>(first[0]), static_cast<double>(first[1]),
                                             static_cast<double>(first[2]));
  mesh::KeptBone kept = mesh::keep_bone(box, X_WB, wanted ? std::optional(wanted->near_W) : std::nullopt);
  mask.inside = std::move(box.inside);
  return kept;
}

/// Whether one of several large pieces of a label is the bone, as of a whole pelvis.
bool is_in_large_pieces(const LabelBone& bone) {
  const std::vector<LabelPiece>& pieces = bone.surface.pieces;
  return std::any_of(pieces.begin(), pieces.end(), [&](const LabelPiece& piece) {
    return !piece.kept && mesh::is_large_piece(piece.voxels, pieces[0].voxels);
  });
}

/// Among the pieces of a surface, most voxels first.
void add_left_out(const std::vector<mesh::LeftOutPiece>& left_out, double voxel_mm3,
                  std::vector<LabelPiece>& pieces) {
  for (const auto& [voxels, is_other_side] : left_out)
    pieces.push_back({voxels, static_cast<double>(voxels) * voxel_mm3, false});
  std::stable_sort(pieces.begin(), pieces.end(),
                   [](const LabelPiece& a, const LabelPiece& b) { return a.voxels > b.voxels; });
}

/// A side of the image that the bone just reaches, as where the image was cropped to it, does not cut it.
void drop_flush_sides(LabelSurface& surface) {
  std::erase_if(surface.caps, [&](const CapPlane& cap) {
    return !kinematics::goes_on_behind(surface.mesh, {cap.normal, cap.offset}, cap.area);
  });
}

std::optional<LabelBone> bone_of(const LabelMap& map, std::string_view file, const LabelBoneRequest& request,
                                 const PieceWanted* wanted, const Control& control) {
  LabelBone bone{.name = {}, .label = chosen_label(map, file, request), .surface = {}, .image = {}};
  bone.name = bone.label.name;
  if (bone.name.empty())
    bone.name = request.label.empty() ? name_of_mask(file) : "label_" + label_numbers(bone.label, "_");
  VoxelMask mask = mask_of(map, bone.label);
  bone.voxels = std::count(mask.inside.begin(), mask.inside.end(), std::uint8_t{1});
  check_size(mask, bone.voxels, file, bone.name);
  const double in_shells = mesh::share_in_shells(map.layers[bone.label.layer], nothing(map), mask);
  const bool chooses = !request.surface.all_pieces;
  const mesh::KeptBone kept = chooses ? keep_bone(wanted, mask) : mesh::KeptBone{};
  LabelSurfaceOptions options = request.surface;
  options.all_pieces |= kept.pieces > 1;
  try {
    auto surface = surface_of(mask, options, control);
    if (!surface) return std::nullopt;
    bone.surface = std::move(*surface);
  } catch (const MeshError& error) {
    throw MeshError(fmt::format("{}: {}: {}", file, bone.name, error.what()));
  }
  drop_flush_sides(bone.surface);
  const double voxel_mm3 = std::abs(mask.image.X_WI.linear().determinant());
  add_left_out(kept.left_out, voxel_mm3, bone.surface.pieces);
  bone.image = image_of(map.grid, bone.surface);
  bone.notes = bone.label.notes;
  double other_side_mm3 = 0;
  for (const mesh::LeftOutPiece& piece : kept.left_out)
    if (piece.is_other_side) other_side_mm3 += static_cast<double>(piece.voxels) * voxel_mm3;
  note_pieces(bone, !wanted ? "the largest" : wanted->words, chooses, other_side_mm3);
  note_shells(bone, in_shells);
  note_cavities(bone, request.surface.keep_cavities, bone.notes);
  note_cuts(bone, bone.notes);
  note_simplification(bone, bone.notes);
  return bone;
}

}  // namespace

BodyImage image_of(const VoxelGrid& grid, const LabelSurface& surface) {
  BodyImage image{grid.X_WI.linear() * surface.slices_in_one.asDiagonal(), {}};
  for (const CapPlane& cap : surface.caps) image.cuts.push_back({cap.normal, cap.offset});
  return image;
}

std::optional<LabelBone> bone_of(const LabelMap& map, std::string_view file, const LabelBoneRequest& request,
                                 const Control& control) {
  return bone_of(map, file, request, nullptr, control);
}

bool take_pieces_of_joint(RequestedBone& fixed, RequestedBone& mobile, const std::optional<Side>& side,
                          const Control& control) {
  const auto take = [&](RequestedBone& of, const PieceWanted& wanted) {
    auto bone = bone_of(of.map, of.file, of.request, &wanted, control);
    if (bone) of.bone = *std::move(bone);
    return bone.has_value();
  };
  // If a bone is in fragments, the one beside the other bone is meant, whichever side it is on.
  const std::vector<JointNote>& notes = mobile.bone.image.notes;
  const bool is_in_fragments = std::any_of(notes.begin(), notes.end(), [](const JointNote& note) {
    return note.code == JointNoteCode::pieces_left_out;
  });
  if (is_in_large_pieces(mobile.bone) &&
      !take(mobile, side && !is_in_fragments ? on_side(*side, mobile.map) : beside(fixed.bone)))
    return false;
  return !is_in_large_pieces(fixed.bone) || take(fixed, beside(mobile.bone));
}

LabelBone bone_of(const LabelMap& map, std::string_view file, const LabelBoneRequest& request) {
  return *bone_of(map, file, request, {});
}

std::optional<Side> side_in_name(std::string_view name) {
  bool left = false, right = false;
  std::string word;
  const auto end_word = [&] {
    left |= word == "left" || word == "l";
    right |= word == "right" || word == "r";
    word.clear();
  };
  for (const char c : name) {
    if (std::isalpha(static_cast<unsigned char>(c)))
      word += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    else
      end_word();
  }
  end_word();
  if (left == right) return std::nullopt;
  return left ? Side::left : Side::right;
}

}  // namespace condyle::io
