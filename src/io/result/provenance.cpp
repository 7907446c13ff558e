#include "condyle/io/provenance.hpp"

#include <fmt/format.h>

#include <utility>
#include <variant>

#include "condyle/error.hpp"
#include "condyle/io/pose_text.hpp"
#include "condyle/version.hpp"
#include "core/one_line.hpp"
#include "io/file/in_quotes.hpp"
#include "io/result/parameters.hpp"
#include "io/result/provenance_forms.hpp"

namespace condyle::io {
namespace {

std::vector<plan::CupAngles> cup_of(const Joint& joint) {
  std::vector<plan::CupAngles> cup;
  for (const CupDefinition definition : all_cup_definitions)
    if (const auto angles = plan::cup_angles(joint, definition)) cup.push_back(*angles);
  return cup;
}

/// Each body's frame in that of its mesh file: in W, unless the body has a frame of its own there.
Pose fixed_in_source(const JointReport& report) noexcept {
  return inverted(report.file.joint.fixed_in_W) * report.placement.X_WF;
}
Pose mobile_in_source(const JointReport& report) noexcept {
  const JointDescription& joint = report.file.joint;
  return inverted(joint.mobile_in_W) * report.placement.X_WF *
         pose_at(joint.coordinates(), report.placement.reference_pose, joint.translation_frame);
}

MeshOrigin origin_of(const std::vector<BodyMeshReport>& meshes, const Pose& in_source, double unit_mm) {
  const Eigen::Affine3d joint_from_source = inverted(in_source) * Eigen::Scaling(unit_mm);
  const Eigen::Affine3d source_from_joint = Eigen::Scaling(1 / unit_mm) * Eigen::Affine3d(in_source);
  MeshOrigin origin{{}, joint_from_source, source_from_joint};
  for (const BodyMeshReport& mesh : meshes)
    origin.files.push_back({mesh.part, mesh.mesh, mesh.digest, mesh.body_from_file});
  return origin;
}

TriMesh moved(const Pose& X, double scale, const TriMesh& mesh) {
  TriMesh out = posed(X, mesh);
  if (scale == 1) return out;
  for (std::vector<double>* axis : {&out.vertices.x, &out.vertices.y, &out.vertices.z})
    for (double& value : *axis) value *= scale;
  return out;
}

/// One word as a shell takes it, on one line whatever it holds.
std::string shell_word(std::string_view word) {
  constexpr std::string_view plain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=:,./%@";
  if (!word.empty() && word.find_first_not_of(plain) == word.npos) return std::string(word);
  std::string out = "'";
  for (const char c : core::one_line(word, word.size())) {
    if (c == '\'')
      out += "'\\''";
    else
      out += c;
  }
  return out + "'";
}

std::vector<double> row_by_row(const Eigen::Affine3d& X) {
  std::vector<double> rows;
  for (int i = 0; i < 4; ++i)
    for (int k = 0; k < 4; ++k) rows.push_back(X(i, k) + 0.0);  // no -0
  return rows;
}

Json matrix_json(const Eigen::Affine3d& X) {
  const std::vector<double> rows = row_by_row(X);
  Json json = Json::array();
  for (std::size_t i = 0; i < 16; i += 4) json.push_back({rows[i], rows[i + 1], rows[i + 2], rows[i + 3]});
  return json;
}

Json source_json(const MeshSource& file) {
  Json json = io::file_json(file.path, file.digest);
  if (!file.source_from_file.matrix().isIdentity(0))
    json["source_from_file"] = matrix_json(file.source_from_file);
  return json;
}

Json mesh_json(const MeshOrigin& mesh) {
  Json json;
  if (mesh.files.size() == 1) {
    json = source_json(mesh.files.front());
  } else {
    for (const MeshSource& file : mesh.files) {
      Json part{{"name", file.part}};
      part.update(source_json(file));
      json["files"].push_back(std::move(part));
    }
  }
  json["joint_from_source"] = matrix_json(mesh.joint_from_source);
  json["source_from_joint"] = matrix_json(mesh.source_from_joint);
  return json;
}

std::string values_text(const std::vector<PosedPart>& parts) {
  std::string text;
  for (const PosedPart& part : parts)
    for (const PartParameter& parameter : part.parameters)
      text += fmt::format("{}{}.{}={}", text.empty() ? "" : " ", part.name, parameter.name, parameter.value);
  return text;
}

std::string files_text(const MeshOrigin& mesh) {
  std::string text;
  for (const MeshSource& file : mesh.files)
    text += (text.empty() ? "" : "; ") + file_text(file.path, file.digest);
  return text;
}

std::string files_text(const std::vector<OtherFile>& files) {
  std::string text;
  for (const OtherFile& file : files) {
    const std::string name = file.path.string();
    text += fmt::format("{}{}, sha256 {}", text.empty() ? "" : "; ", core::one_line(name, name.size()),
                        file.sha256);
  }
  return text;
}

}  // namespace

std::string_view name_of(AnswerFrameName name) noexcept {
  return name == AnswerFrameName::joint ? "joint" : "source";
}

AnswerFrameName answer_frame_named(std::string_view name) {
  for (const AnswerFrameName known : {AnswerFrameName::joint, AnswerFrameName::source})
    if (name_of(known) == name) return known;
  throw UsageError(fmt::format("unknown frame {}; there are joint and source", io::in_quotes(name)));
}

AnswerFrame::AnswerFrame(AnswerFrameName name, const JointReport& report) : name_(name) {
  if (name == AnswerFrameName::joint) return;
  X_SF_ = fixed_in_source(report);
  X_SM_ = mobile_in_source(report);
  per_mm_ = 1 / mm_per(report.file.joint.units);
}

AnswerFrame AnswerFrame::of_held(const Vec3& translation_mm) const {
  AnswerFrame frame = *this;
  frame.held_ = translation_mm;
  return frame;
}

Vec3 AnswerFrame::fixed_point(const Vec3& p_F) const noexcept {
  const Vec3 p = held_ == Vec3::Zero() ? p_F : Vec3(p_F + held_);
  return name_ == AnswerFrameName::joint ? p : posed(X_SF_, p);
}
Vec3 AnswerFrame::fixed_direction(const Vec3& d_F) const noexcept {
  return name_ == AnswerFrameName::joint ? d_F : Vec3(X_SF_.linear() * d_F);
}
Vec3 AnswerFrame::mobile_point(const Vec3& p_M) const noexcept {
  return name_ == AnswerFrameName::joint ? p_M : posed(X_SM_, p_M);
}
TriMesh AnswerFrame::fixed_mesh(const TriMesh& mesh) const {
  const Pose back{Eigen::Translation3d(held_)};
  if (name_ == AnswerFrameName::joint) return held_ == Vec3::Zero() ? mesh : posed(back, mesh);
  return moved(X_SF_ * back, per_mm_, mesh);
}
TriMesh AnswerFrame::mobile_mesh(const TriMesh& mesh) const {
  return name_ == AnswerFrameName::joint ? mesh : moved(X_SM_, per_mm_, mesh);
}

Provenance provenance_of(const LoadedJoint& loaded, std::vector<std::string> command, AnswerFrameName frame) {
  const JointReport& report = loaded.report;
  const double unit_mm = mm_per(report.file.joint.units);
  return {std::move(command),
          report.file.path,
          report.file.digest,
          loaded.joint.side,
          origin_of(report.fixed, fixed_in_source(report), unit_mm),
          origin_of(report.mobile, mobile_in_source(report), unit_mm),
          AnswerFrame(frame, report),
          files_of(report.file),
          loaded.joint.posed ? loaded.joint.posed->parts : std::vector<PosedPart>{},
          cup_of(loaded.joint),
          {},
          loaded.joint.planned,
          report.file.joint.units};
}

std::string command_text(const std::vector<std::string>& words) {
  std::string text = "condyle";
  for (const std::string& word : words) text += " " + shell_word(word);
  return text;
}

std::string file_text(const std::filesystem::path& path, const FileDigest& digest) {
  const std::string name = path.string();
  return fmt::format("{}, {} bytes, sha256 {}", core::one_line(name, name.size()), digest.bytes,
                     digest.sha256);
}

Json file_json(const std::filesystem::path& path, const FileDigest& digest) {
  return {{"path", path.string()}, {"bytes", digest.bytes}, {"sha256", digest.sha256}};
}

Json provenance_json(const Provenance* from) {
  if (from == nullptr) return nullptr;
  Json json{{"version", condyle::version},
            {"command", from->command},
            {"joint_file", file_json(from->joint_path, from->joint_digest)},
            {"side", name_of(from->side)},
            {"frame", name_of(from->frame.name())},
            {"units_of_meshes", name_of(from->units_of_meshes)},
            {"fixed_mesh", mesh_json(from->fixed)},
            {"mobile_mesh", mesh_json(from->mobile)}};
  if (!from->planned.empty()) json["planned"] = from->planned;
  if (!from->parts.empty()) json["parameters"] = parameters_json(from->parts);
  if (Json cuts = cuts_json(from->parts); !cuts.empty()) json["cuts"] = std::move(cuts);
  if (!from->cup.empty()) json["cup"] = cup_json(from->cup);
  for (const OtherFile& file : from->other_files)
    json["other_files"].push_back({{"path", file.path.string()}, {"sha256", file.sha256}});
  return json;
}

std::vector<VtpField> provenance_fields(const Provenance* from) {
  if (from == nullptr) return {};
  // One by one: GCC 12 destroys what an initializer list never built if one of its elements throws.
  std::vector<VtpField> fields;
  const auto add = [&](std::string name, std::variant<std::string, std::vector<double>> value) {
    fields.push_back({std::move(name), std::move(value)});
  };
  add("condyle_version", std::string(condyle::version));
  add("condyle_command", command_text(from->command));
  add("joint_file", file_text(from->joint_path, from->joint_digest));
  add("fixed_mesh", files_text(from->fixed));
  add("mobile_mesh", files_text(from->mobile));
  add("side", std::string(name_of(from->side)));
  add("frame", std::string(name_of(from->frame.name())));
  add("units_of_meshes", std::string(name_of(from->units_of_meshes)));
  if (!from->planned.empty()) add("planned", from->planned);
  if (!from->parts.empty()) add("parameters", values_text(from->parts));
  if (!from->other_files.empty()) add("other_files", files_text(from->other_files));
  add("fixed_joint_from_source", row_by_row(from->fixed.joint_from_source));
  add("fixed_source_from_joint", row_by_row(from->fixed.source_from_joint));
  add("mobile_joint_from_source", row_by_row(from->mobile.joint_from_source));
  add("mobile_source_from_joint", row_by_row(from->mobile.source_from_joint));
  return fields;
}

std::string provenance_comments(const Provenance* from) {
  std::string text;
  for (const auto& [name, value] : provenance_fields(from)) {
    text += fmt::format("# {}:", name);
    if (const auto* words = std::get_if<std::string>(&value))
      text += " " + *words;
    else
      for (const double number : std::get<std::vector<double>>(value)) text += fmt::format(" {}", number);
    text += "\n";
  }
  return text;
}

std::string provenance_comments(const Provenance* from, std::span<const JointNote> notes) {
  std::string text = provenance_comments(from);
  if (from)
    for (const JointNote& note : notes)
      text += fmt::format("# note: {}: {}\n", name_of(note.code), note.text);
  return text;
}

}  // namespace condyle::io
