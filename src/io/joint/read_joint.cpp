#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "condyle/error.hpp"
#include "condyle/implant.hpp"
#include "condyle/io/joint_file.hpp"
#include "condyle/io/mesh_file.hpp"
#include "io/file/read_pair.hpp"
#include "io/file/whole_file.hpp"
#include "io/joint/load_joint.hpp"
#include "io/mesh/polygon_rule.hpp"
#include "io/motion/column_zero.hpp"
#include "io/result/repair_text.hpp"
#include "mesh/enclosed_volume.hpp"

namespace condyle::io {
namespace {

/// Appends a mesh to those before it.
void append_mesh(TriMesh& whole, const TriMesh& mesh) {
  const auto first = static_cast<Index>(whole.vertices.size());
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) whole.vertices.push_back(mesh.vertices[v]);
  for (const auto& [a, b, c] : mesh.triangles) whole.triangles.push_back({a + first, b + first, c + first});
}

/// A mesh of a body, and what became of it.
struct LoadedMesh {
  TriMesh mesh;
  BodyMeshReport report;
};

/// A body by its file or files: that is what errors name.
struct LoadedBody {
  Body body;
  std::vector<BodyMeshReport> reports;
};

/// `key` and the joint file are named where the mesh cannot be opened: it may be the key that is wrong.
void check_mesh_exists(const MeshEntry& entry, const std::string& key,
                       const std::filesystem::path& joint_file) {
  if (const std::string why = io::why_no_file(entry.mesh); !why.empty())
    throw FileError(fmt::format("{}: {}.mesh: {}", joint_file.string(), key, why));
}

/// Into the body's frame. A mirrored mesh has its triangles turned round, so that it keeps its inside.
void move(TriMesh& mesh, const Eigen::Affine3d& body_from_file) {
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
    mesh.vertices.set(v, body_from_file * mesh.vertices[v]);
  if (body_from_file.linear().determinant() < 0)
    for (Triangle& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
}

/// The joint centre in the frame of a body's file, in its unit; empty if it is not stated.
std::optional<Vec3> centre_in_file(const JointDescription& joint, BodyRole body) {
  const auto* centre = std::get_if<Vec3>(&joint.frame.centre);
  if (!centre) return std::nullopt;
  const Pose& X_WB = body == BodyRole::fixed ? joint.fixed_in_W : joint.mobile_in_W;
  return Vec3(inverted(X_WB) * *centre / mm_per(joint.units));
}

/// The pieces that the rule keeps, and in a line what it leaves out.
TriMesh chosen_pieces(TriMesh whole, const MeshEntry& entry, const std::string& key, const JointFile& file,
                      BodyRole body, std::string& left_out) {
  if (entry.pieces == PieceRule::all) return whole;
  const Mesh mesh(std::move(whole));
  const auto centre = centre_in_file(file.joint, body);
  if (entry.pieces == PieceRule::at_joint && !centre)
    throw FileError(fmt::format("{}: {}.pieces: \"at_joint\" needs a centre that is stated in frame.centre",
                                file.path.string(), key));
  TriMesh kept = entry.pieces == PieceRule::largest ? largest_piece(mesh) : piece_at(mesh, *centre);
  if (const std::size_t less = mesh.triangles().size() - kept.triangles.size(); less > 0)
    left_out =
        fmt::format("{} of {} triangles left out: pieces beside {}", less, mesh.triangles().size(),
                    entry.pieces == PieceRule::largest ? "the largest" : "the one at the joint centre");
  return kept;
}

LoadedMesh load(const MeshEntry& entry, const std::string& key, const JointFile& joint, BodyRole body) {
  const std::filesystem::path& joint_file = joint.path;
  check_mesh_exists(entry, key, joint_file);
  io::check_is_file(entry.mesh);
  const MeshFormat format = mesh_format_of(entry.mesh);
  FileDigest digest;
  const std::string bytes = io::read_whole_file(entry.mesh, &digest);
  MeshFile file = read_mesh(bytes, format, entry.mesh.string(), entry.polygons);
  BodyMeshReport report{entry.part, entry.mesh, 0, 0, file.welded_vertices, {}, std::move(digest)};
  report.split_polygons = file.split_polygons;
  report.guessed_polygons = file.guessed_polygons;
  report.guessed_within = file.guessed_within;
  if (entry.is_moved()) {
    report.body_from_file = Eigen::Affine3d(entry.X_BG) * Eigen::Scaling(entry.scale);
    move(file.mesh, report.body_from_file);
  }
  try {
    report.repairs = repair_mesh(file.mesh, entry.repairs);
  } catch (const MeshError& error) {
    throw MeshError(fmt::format("{}: {}", entry.mesh.string(), error.what()));
  }
  file.mesh = chosen_pieces(std::move(file.mesh), entry, key, joint, body, report.left_out);
  report.vertices = file.mesh.vertices.size();
  report.triangles = file.mesh.triangles.size();
  return {std::move(file.mesh), std::move(report)};
}

/// `is_cut`: a part is cut from the body, which has its mesh named for that.
LoadedBody load(const BodyEntry& entry, BodyRole body, bool is_cut, const JointFile& joint) {
  const std::string key = body == BodyRole::fixed ? "fixed" : "mobile";
  if (entry.meshes.size() == 1) {
    const MeshEntry& mesh = entry.meshes.front();
    const bool in_list = !mesh.part.empty();
    LoadedMesh only = load(mesh, in_list ? key + ".meshes[0]" : key, joint, body);
    std::vector<BodyPart> parts;
    if (is_cut)
      parts.push_back({in_list ? mesh.part : entry.name, 0, only.mesh.vertices.size(), 0,
                       only.mesh.triangles.size(), mesh.contact});
    return {{mesh.mesh.string(), std::move(only.mesh), std::move(parts), entry.image, entry.head,
             entry.bearing_margin_mm},
            {std::move(only.report)}};
  }
  TriMesh whole;
  std::vector<BodyPart> parts;
  std::vector<BodyMeshReport> reports;
  std::string files;
  for (std::size_t i = 0; i < entry.meshes.size(); ++i) {
    LoadedMesh one = load(entry.meshes[i], fmt::format("{}.meshes[{}]", key, i), joint, body);
    parts.push_back({one.report.part, whole.vertices.size(), one.report.vertices, whole.triangles.size(),
                     one.report.triangles, entry.meshes[i].contact});
    append_mesh(whole, one.mesh);
    reports.push_back(std::move(one.report));
    files += (files.empty() ? "" : " + ") + entry.meshes[i].mesh.string();
  }
  return {{files, std::move(whole), std::move(parts), entry.image, entry.head, entry.bearing_margin_mm},
          std::move(reports)};
}

PlacedJoint placed(const JointFile& file, Body fixed, Body mobile) {
  try {
    PlacedJoint made = make_joint(file.joint, std::move(fixed), std::move(mobile));
    made.joint.fixed.name = file.fixed.name;
    made.joint.mobile.name = file.mobile.name;
    if (file.implant) made.joint.implant = plan::implant_in_joint(*file.implant, made.joint);
    return made;
  } catch (const UsageError& error) {
    throw FileError(fmt::format("{}: {}", file.path.string(), error.what()));
  } catch (const MeshError& error) {
    throw MeshError(fmt::format("{}: {}", file.path.string(), error.what()));
  }
}

std::string file_name(const BodyMeshReport& body) {
  return body.mesh.filename().string();
}

void note_repairs(const BodyMeshReport& body, std::vector<std::string>& notes) {
  if (body.welded_vertices > 0)
    notes.push_back(fmt::format("{}: merged {} duplicate vertices", file_name(body), body.welded_vertices));
  if (body.split_polygons > 0)
    notes.push_back(
        fmt::format("{}: {}", file_name(body),
                    io::split_text(body.split_polygons, body.guessed_polygons, body.guessed_within)));
  if (body.body_from_file.linear().determinant() < 0)
    notes.push_back(fmt::format("{}: mirrored by its scale, triangles turned round", file_name(body)));
  for (const RepairDone& done : body.repairs)
    notes.push_back(fmt::format("{}: {}", file_name(body), io::describe(done)));
  if (!body.left_out.empty()) notes.push_back(fmt::format("{}: {}", file_name(body), body.left_out));
}

std::vector<std::string> processing_of(const JointReport& report) {
  std::vector<std::string> notes;
  const JointPlacement& placement = report.placement;
  if (const LengthUnit units = report.file.joint.units; units != LengthUnit::millimetres)
    notes.push_back(fmt::format("meshes and lengths converted from {} to mm", plural_of(units)));
  notes.insert(notes.end(), report.file.processing.begin(), report.file.processing.end());
  for (const auto* meshes : {&report.fixed, &report.mobile})
    for (const BodyMeshReport& mesh : *meshes) note_repairs(mesh, notes);
  notes.insert(notes.end(), placement.processing.begin(), placement.processing.end());
  return notes;
}

}  // namespace

LoadedJoint load_joint(JointFile file) {
  const auto is_cut = [&](BodyRole body) {
    return std::any_of(file.joint.parts.begin(), file.joint.parts.end(), [&](const DescribedPart& part) {
      return part.part.body == body && !part.part.cut.empty();
    });
  };
  std::optional<LoadedBody> fixed, mobile;
  io::read_pair([&] { fixed = load(file.fixed, BodyRole::fixed, is_cut(BodyRole::fixed), file); },
                [&] { mobile = load(file.mobile, BodyRole::mobile, is_cut(BodyRole::mobile), file); });
  PlacedJoint made = placed(file, std::move(fixed->body), std::move(mobile->body));
  JointReport report{
      std::move(file), std::move(fixed->reports), std::move(mobile->reports), std::move(made.placement), {}};
  report.processing = processing_of(report);
  LoadedJoint loaded{std::move(made.joint), std::move(report)};
  if (auto& zero = loaded.report.file.recorded_zero)
    zero = io::zero_in_joint(
        *zero, std::get<std::vector<ColumnOfCoordinate>>(*loaded.report.file.recorded_motion), loaded);
  return loaded;
}

LoadedJoint read_joint(const std::filesystem::path& path) {
  return io::load_joint(read_joint_file(path));
}

LoadedJoint::operator Case() const {
  return {.joint = joint,
          .placement = report.placement,
          .own_motions = report.file.motions,
          .uncertainty = report.file.uncertainty,
          .band_seed = report.file.band_seed,
          .pelvis_frame = measure::pelvis_frame_of(report.file.joint.frame)};
}

LoadedJoint with_parameters(const LoadedJoint& loaded, std::span<const ParameterValue> values) {
  LoadedJoint moved{with_parameters(loaded.joint, values), loaded.report};
  moved.report.placement.fixed.bounds = mesh::bounds_of_vertices(moved.joint.fixed.mesh);
  moved.report.placement.mobile.bounds = mesh::bounds_of_vertices(moved.joint.mobile.mesh);
  return moved;
}

}  // namespace condyle::io
