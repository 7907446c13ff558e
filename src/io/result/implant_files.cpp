#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <string_view>
#include <utility>

#include "condyle/io/mesh_file.hpp"
#include "condyle/version.hpp"
#include "io/file/format_version.hpp"
#include "io/file/output_folder.hpp"
#include "io/file/whole_file.hpp"
#include "io/joint/implant_parts.hpp"
#include "io/joint/implant_table.hpp"
#include "io/joint/part_tables.hpp"
#include "io/joint/proposal_lines.hpp"
#include "io/joint/settings_lines.hpp"
#include "io/motion/column_zero.hpp"
#include "io/result/implant_result.hpp"
#include "io/result/provenance_forms.hpp"

namespace condyle::io {
namespace {

constexpr std::string_view of_fixed[] = {"liner"}, of_mobile[] = {"head", "neck", "stem"};

/// Bones are numbered and meshes of the implant have its names: those of bones may be no names of files.
std::vector<std::string> files_of(std::string_view role, const Body& body) {
  const auto implant = role == "fixed" ? std::span<const std::string_view>(of_fixed)
                                       : std::span<const std::string_view>(of_mobile);
  std::vector<std::string> files;
  for (std::size_t i = 1; i + implant.size() <= body.parts.size(); ++i)
    files.push_back(i == 1 ? fmt::format("{}_bone.ply", role) : fmt::format("{}_bone_{}.ply", role, i));
  for (const std::string_view each : implant) files.push_back(fmt::format("{}.ply", each));
  return files;
}

/// Whether some result has a file of this name.
bool is_of_implant(std::string_view name) {
  static constexpr std::string_view names[] = {"implant.json",    "hip.toml",  "fixed_bone.ply",
                                               "mobile_bone.ply", "liner.ply", "head.ply",
                                               "neck.ply",        "stem.ply"};
  if (std::find(std::begin(names), std::end(names), name) != std::end(names)) return true;
  for (const std::string_view bone : {"fixed_bone_", "mobile_bone_"})
    if (name.starts_with(bone) && name.ends_with(".ply"))
      return name.find_first_not_of("0123456789", bone.size()) == name.size() - 4;
  return false;
}

void write_body(OutputFolder& out, std::string_view role, const Body& body) {
  const std::vector<std::string> files = files_of(role, body);
  for (std::size_t i = 0; i < files.size(); ++i)
    write_mesh(out.file(files[i]), mesh_of_part(body, body.parts[i].name));
}

void add_body(ProposalLines& lines, std::string_view role, const Body& body) {
  lines.add(fmt::format("\n[{}]", role));
  lines.add("name = " + io::toml_text(body.name));
  const std::vector<std::string> files = files_of(role, body);
  for (std::size_t i = 0; i < files.size(); ++i) {
    lines.add(fmt::format("[[{}.meshes]]", role));
    lines.add("name = " + io::toml_text(body.parts[i].name));
    lines.add(fmt::format("mesh = \"{}\"", files[i]));
  }
  io::add_image(lines, role, body.image);
}

std::string name_with_implant(const Joint& joint) {
  return joint.name + " with a total hip";
}

/// The centre is that of cup and head, which are given and not measured; surfaces and axes are those of the bones before.
motion::Uncertainty uncertainty_of(const JointFile* file) {
  motion::Uncertainty sigma = file ? file->uncertainty : motion::Uncertainty{};
  sigma.centre_mm = 0;
  return sigma;
}

/// Whether the joint file has columns of coordinates that count from the joint's own zero, and so from that about the implant's centre.
bool columns_about_implant(const ImplantResult& result) {
  const JointFile* file = result.file;
  return file && file->recorded_motion &&
         std::holds_alternative<std::vector<ColumnOfCoordinate>>(*file->recorded_motion) &&
         !(file->recorded_zero && is_moved(*file->recorded_zero, result.joint));
}

}  // namespace

std::string implant_joint_file(const ImplantResult& result) {
  const Joint& joint = result.answer.joint;
  const plan::Implant implant = result.answer.hip;
  ProposalLines lines;
  lines.add(fmt::format("# Written by condyle implant {}.", version));
  lines.add(fmt::format("condyle = {}", io::format_version));
  lines.add("name = " + io::toml_text(name_with_implant(result.joint)));
  lines.add("planned = " + io::toml_text(joint.planned));
  lines.add(
      fmt::format("kind = \"ball\"\njoint = \"hip\"\nside = \"{}\"\nunits = \"mm\"", name_of(joint.side)));
  add_body(lines, "fixed", joint.fixed);
  add_body(lines, "mobile", joint.mobile);
  lines.add("\n[frame]  # the meshes are in the joint frame, about the centre of cup and head");
  lines.add("centre = [0, 0, 0]\nanterior = [1, 0, 0]\nsuperior = [0, 1, 0]\n");
  if (joint.zero_from != ZeroFrom::as_given) lines.add("[reference_pose]  # as the bones were given\n");
  lines.add(io::implant_text(implant) + io::parts_text(io::implant_parts(implant, BonesAround::some)));
  JointFile file = result.file ? *result.file : JointFile{};
  if (file.recorded_motion && !columns_about_implant(result)) file.recorded_motion = ColumnsOfPoses{};
  file.recorded_zero.reset();
  io::add_settings(lines, file, joint, uncertainty_of(result.file));
  return std::move(lines).proposal(joint.side).toml;
}

LoadedJoint joint_with_implant(const ImplantResult& result) {
  const ImplantAnswer& answer = result.answer;
  JointReport report;
  JointFile& file = report.file;
  file.implant = answer.hip;
  file.joint.name = name_with_implant(result.joint);
  file.joint.planned = answer.joint.planned;
  file.joint.side = result.joint.side;
  file.joint.frame.centre = Vec3(Vec3::Zero());
  if (answer.joint.zero_from != ZeroFrom::as_given) file.joint.zero_from = ZeroFrom::stated;
  for (PosedPart& part : io::implant_parts(answer.hip, BonesAround::some))
    file.joint.parts.push_back({std::move(part)});
  if (result.file) {
    file.motions = result.file->motions, file.band_seed = result.file->band_seed;
    if (columns_about_implant(result)) file.recorded_motion = result.file->recorded_motion;
  }
  file.uncertainty = uncertainty_of(result.file);
  auto [joint, placement] = make_joint(file.joint, answer.joint.fixed, answer.joint.mobile);
  report.processing = placement.processing;
  report.placement = std::move(placement);
  joint.implant = plan::implant_in_joint(answer.hip, joint);
  return {std::move(joint), std::move(report)};
}

void check_implant_folder(const std::filesystem::path& folder, const Provenance* from) {
  OutputFolder{folder, is_of_implant, io::files_read(from)};
}

std::vector<std::filesystem::path> write_implant(const std::filesystem::path& folder,
                                                 const ImplantResult& result) {
  OutputFolder out(folder, is_of_implant, io::files_read(result.provenance), "implant.json");
  io::write_whole_file(out.file("implant.json"), io::implant_json(result));
  io::write_whole_file(out.file("hip.toml"), implant_joint_file(result));
  write_body(out, "fixed", result.answer.joint.fixed);
  write_body(out, "mobile", result.answer.joint.mobile);
  return out.commit();
}

}  // namespace condyle::io
