#include "condyle/io/label_file.hpp"

#include <fmt/format.h>

#include <cctype>

#include "core/one_line.hpp"
#include "io/image/joint_bones.hpp"

namespace condyle::io {
namespace {

/// A name that every file system takes.
std::string file_name_of(std::string_view name) {
  std::string out;
  for (const char c : name) out += std::isalnum(static_cast<unsigned char>(c)) || c == '-' ? c : '_';
  return out + ".ply";
}

ProposedBody body_of(const LabelBone& bone, const std::filesystem::path& mesh,
                     const std::filesystem::path& image) {
  ProposedBody body{bone.surface.mesh, mesh, bone.name, io::origin_of(bone, image.filename().string()),
                    bone.image};
  for (const LabelNote& note : bone.notes)
    body.comments.push_back(fmt::format("{}: {}", name_of(note.code), note.text));
  return body;
}

}  // namespace

std::optional<LabelJoint> propose_joint(const LabelMap& map, const LabelMap* other,
                                        const LabelJointRequest& request, const Control& control) {
  const LabelMap& mobile_map = other ? *other : map;
  const std::filesystem::path& mobile_file = request.mobile_labels ? *request.mobile_labels : request.labels;
  const std::string fixed_name = request.labels.string(), mobile_name = mobile_file.string();

  auto fixed = bone_of(map, fixed_name, request.fixed, control);
  if (!fixed) return std::nullopt;
  auto mobile = bone_of(mobile_map, mobile_name, request.mobile, control);
  if (!mobile) return std::nullopt;
  io::RequestedBone wanted_fixed{map, fixed_name, request.fixed, *std::move(fixed)},
      wanted_mobile{mobile_map, mobile_name, request.mobile, *std::move(mobile)};
  if (!io::take_pieces_of_joint(wanted_fixed, wanted_mobile, request.side, control)) return std::nullopt;
  std::vector<LabelNote> notes = io::record_notes(wanted_fixed, wanted_mobile);
  const ImagedBone of_fixed{map, fixed_name, wanted_fixed.bone},
      of_mobile{mobile_map, mobile_name, wanted_mobile.bone};
  io::check_are_two(of_fixed, of_mobile);

  ProposalFacts facts{
      .joint_file = request.joint_file,
      .from = "bones of the label map " + core::one_line(request.labels.filename().string(), 200),
      .side = io::stated_side(request.side, of_fixed.bone, of_mobile.bone, request.side_by),
      .units = Stated<LengthUnit>{LengthUnit::millimetres, "of surfaces from label maps"},
      .axes_by = "surfaces from label maps are in LPS, by the image's header"};
  const std::filesystem::path folder = request.joint_file.parent_path();
  LabelJoint joint{std::move(wanted_fixed.bone), std::move(wanted_mobile.bone), {}, {}, {}, std::move(notes)};
  joint.fixed_mesh = folder / file_name_of(joint.fixed.name);
  joint.mobile_mesh = folder / file_name_of(joint.mobile.name);
  if (joint.fixed_mesh == joint.mobile_mesh) {
    joint.fixed_mesh = folder / file_name_of("fixed_" + joint.fixed.name);
    joint.mobile_mesh = folder / file_name_of("mobile_" + joint.mobile.name);
  }
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

}  // namespace condyle::io
