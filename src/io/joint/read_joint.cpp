#include <fmt/format.h>

#include <utility>

#include "condyle/error.hpp"
#include "condyle/io/joint_file.hpp"
#include "condyle/io/mesh_file.hpp"
#include "condyle/io/repair_text.hpp"
#include "io/file/whole_file.hpp"

namespace condyle {
namespace {

/// A body by its file: that is what errors name.
struct LoadedBody {
  Body body;
  BodyReport report;
};

/// `key` and the joint file are named where the mesh cannot be opened: it may be the key that is wrong.
void check_mesh_exists(const BodyEntry& entry, std::string_view key,
                       const std::filesystem::path& joint_file) {
  std::error_code ignored;
  if (!std::filesystem::exists(entry.mesh, ignored))
    throw FileError(
        fmt::format("{}: {}.mesh: there is no file {}", joint_file.string(), key, entry.mesh.string()));
}

LoadedBody load(const BodyEntry& entry, std::string_view key, const std::filesystem::path& joint_file) {
  check_mesh_exists(entry, key, joint_file);
  io::check_is_file(entry.mesh);
  const MeshFormat format = mesh_format_of(entry.mesh);
  const std::string bytes = io::read_whole_file(entry.mesh);
  MeshFile file = read_mesh(bytes, format, entry.mesh.string());
  BodyReport report{entry.mesh, 0, 0, file.welded_vertices, {}, digest_of(bytes)};
  try {
    report.repairs = repair_mesh(file.mesh, entry.repairs);
  } catch (const MeshError& error) {
    throw MeshError(fmt::format("{}: {}", entry.mesh.string(), error.what()));
  }
  report.vertices = file.mesh.vertices.size();
  report.triangles = file.mesh.triangles.size();
  return {{entry.mesh.string(), std::move(file.mesh)}, std::move(report)};
}

PlacedJoint placed(const JointFile& file, Body fixed, Body mobile) {
  try {
    PlacedJoint made = make_joint(file.joint, std::move(fixed), std::move(mobile));
    made.joint.fixed.name = file.fixed.name;
    made.joint.mobile.name = file.mobile.name;
    return made;
  } catch (const UsageError& error) {
    throw FileError(fmt::format("{}: {}", file.path.string(), error.what()));
  } catch (const MeshError& error) {
    throw MeshError(fmt::format("{}: {}", file.path.string(), error.what()));
  }
}

std::string file_name(const BodyReport& body) {
  return body.mesh.filename().string();
}

void note_repairs(const BodyReport& body, std::vector<std::string>& notes) {
  if (body.welded_vertices > 0)
    notes.push_back(fmt::format("{}: merged {} duplicate vertices", file_name(body), body.welded_vertices));
  for (const RepairDone& done : body.repairs)
    notes.push_back(fmt::format("{}: {}", file_name(body), describe(done)));
}

std::vector<std::string> notes_on(const JointReport& report) {
  std::vector<std::string> notes;
  const JointPlacement& placement = report.placement;
  if (report.file.joint.units == LengthUnit::metres)
    notes.push_back("meshes and lengths converted from metres to mm");
  note_repairs(report.fixed, notes);
  note_repairs(report.mobile, notes);
  notes.insert(notes.end(), placement.notes.begin(), placement.notes.end());
  return notes;
}

}  // namespace

LoadedJoint read_joint(const std::filesystem::path& path) {
  JointFile file = read_joint_file(path);
  LoadedBody fixed = load(file.fixed, "fixed", file.path), mobile = load(file.mobile, "mobile", file.path);
  PlacedJoint made = placed(file, std::move(fixed.body), std::move(mobile.body));
  JointReport report{
      std::move(file), std::move(fixed.report), std::move(mobile.report), std::move(made.placement), {}};
  report.notes = notes_on(report);
  return {std::move(made.joint), std::move(report)};
}

}  // namespace condyle
