#include "io/result/sample_files.hpp"

#include <fmt/format.h>

#include <algorithm>

#include <limits>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "condyle/error.hpp"
#include "condyle/io/mesh_file.hpp"
#include "condyle/io/pose_text.hpp"
#include "io/file/format_version.hpp"
#include "io/file/whole_file.hpp"
#include "io/image/write_labels.hpp"
#include "io/joint/implant_parts.hpp"
#include "io/joint/implant_table.hpp"
#include "io/joint/part_tables.hpp"
#include "io/mesh/ply_bytes.hpp"
#include "mesh/voxelise.hpp"
#include "plan/joined_body.hpp"

namespace condyle::io {
namespace {

struct BodyFile {
  const char *name, *mesh;
};

std::string joint_file_text(const std::string& joint, const std::string& fixed, const std::string& mobile,
                            Side side, std::string_view anatomy = {}) {
  return fmt::format(R"(condyle = {}
name = "{}"
kind = "ball"
{}side = "{}"
units = "mm"

[fixed]
{}
[mobile]
{}
[reference_pose]  # as given: the bones are in neutral

[frame]
centre = [0.0, 0.0, 0.0]
anterior = [1.0, 0.0, 0.0]
superior = [0.0, 1.0, 0.0]
)",
                     io::format_version, joint,
                     anatomy.empty() ? "" : fmt::format("joint = \"{}\"\n", anatomy), name_of(side), fixed,
                     mobile);
}

std::string joint_file_text(const std::string& joint, const BodyFile& fixed, const BodyFile& mobile,
                            Side side) {
  const auto body = [](const BodyFile& file) {
    return fmt::format("name = \"{}\"\nmesh = \"{}\"\n", file.name, file.mesh);
  };
  return joint_file_text(joint, body(fixed), body(mobile), side);
}

/// Writes a mesh for each part.
std::string body_of_parts(OutputFolder& out, std::string_view name,
                          const std::vector<plan::ImplantMesh>& parts) {
  std::string meshes;
  for (const auto& [part, mesh] : parts) {
    const std::string file = part + ".ply";
    write_mesh(out.file(file), mesh);
    meshes += fmt::format("{}{{ name = \"{}\", mesh = \"{}\" }}", meshes.empty() ? "" : ",\n          ", part,
                          file);
  }
  return fmt::format("name = \"{}\"\nmeshes = [{}]\n", name, meshes);
}

struct ImplantNames {
  std::string joint, fixed, mobile;
};

/// A body of one mesh is called after it, as there answers name no part.
ImplantNames names_of(const plan::ImplantMeshes& meshes, const plan::Implant& implant, Side side) {
  const bool is_hip = std::holds_alternative<plan::TotalHip>(implant);
  return {fmt::format("{} replacement of the {} {}", is_hip ? "total" : "reverse", name_of(side),
                      is_hip ? "hip" : "shoulder"),
          meshes.fixed.size() == 1 ? meshes.fixed.front().part
          : is_hip                 ? "pelvis"
                                   : "scapula",
          is_hip ? "femur" : "humerus"};
}

BonesAround bones_around(const plan::ImplantMeshes& meshes) {
  return meshes.fixed.size() > 1 ? BonesAround::some : BonesAround::none;
}

}  // namespace

std::vector<FileBytes> sample_hip_files(const sample::SampleHip& hip, Side side) {
  const BodyFile hip_bone = {"hip bone", "hip_bone.ply"}, femur = {"femur", "femur.ply"};
  return {{hip_bone.mesh, ply_bytes(hip.hip_bone)},
          {femur.mesh, ply_bytes(hip.femur)},
          {"hip.toml", joint_file_text(fmt::format("sample {} hip", name_of(side)), hip_bone, femur, side)}};
}

void write_sample_hip(OutputFolder& out, const sample::SampleHip& hip, Side side) {
  for (const auto& [name, bytes] : sample_hip_files(hip, side)) io::write_whole_file(out.file(name), bytes);
}

void write_sample_implant(OutputFolder& out, const plan::ImplantMeshes& meshes, const plan::Implant& implant,
                          Side side) {
  const ImplantNames names = names_of(meshes, implant, side);
  const std::string fixed = body_of_parts(out, names.fixed, meshes.fixed),
                    mobile = body_of_parts(out, names.mobile, meshes.mobile);
  const bool is_hip = std::holds_alternative<plan::TotalHip>(implant);
  io::write_whole_file(out.file(is_hip ? "hip.toml" : "shoulder.toml"),
                       joint_file_text(names.joint, fixed, mobile, side, is_hip ? "hip" : "shoulder") + "\n" +
                           io::implant_text(implant) +
                           io::parts_text(io::implant_parts(implant, bones_around(meshes))) +
                           "\n[uncertainty]  # sizes of an implant are given, not measured\n"
                           "centre = 0.0\nsurface = 0.0\n");
}

LoadedJoint sample_implant_joint(const plan::ImplantMeshes& meshes, const plan::Implant& implant, Side side) {
  const ImplantNames names = names_of(meshes, implant, side);
  JointReport report;
  report.file.implant = implant;
  report.file.joint.name = names.joint;
  report.file.joint.side = side;
  report.file.joint.anatomy =
      std::holds_alternative<plan::TotalHip>(implant) ? Anatomy::hip : Anatomy::shoulder;
  report.file.joint.frame.centre = Vec3(Vec3::Zero());
  report.file.joint.zero_from = ZeroFrom::stated;
  for (PosedPart& part : io::implant_parts(implant, bones_around(meshes)))
    report.file.joint.parts.push_back({std::move(part)});
  report.file.uncertainty = {.centre_mm = 0, .surface_mm = 0, .surface_voxels = 0};
  auto [joint, placement] = make_joint(report.file.joint, plan::joined_body(names.fixed, meshes.fixed),
                                       plan::joined_body(names.mobile, meshes.mobile));
  report.processing = placement.processing;
  report.placement = std::move(placement);
  joint.implant = plan::implant_in_joint(implant, joint);
  return {std::move(joint), std::move(report)};
}

void write_sample_labels(OutputFolder& out, const sample::SampleHip& hip, Side side, double voxel_mm) {
  constexpr double finest_mm = 0.2, coarsest_mm = 5;
  if (!(voxel_mm >= finest_mm && voxel_mm <= coarsest_mm))
    throw UsageError(fmt::format("voxel: from {} to {} mm", finest_mm, coarsest_mm));
  // The joint frame in LPS, then in voxels.
  Eigen::Matrix3d lps_from_joint;
  lps_from_joint << 0, 0, -1, -1, 0, 0, 0, 1, 0;
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (const TriMesh* mesh : {&hip.hip_bone, &hip.femur})
    for (std::size_t v = 0; v < mesh->vertices.size(); ++v) {
      const Vec3 p = lps_from_joint * mesh->vertices[v];
      low = low.cwiseMin(p), high = high.cwiseMax(p);
    }
  constexpr int margin = 4;  // voxels
  VoxelGrid grid;
  // Floats hold the place exactly, as the file has it.
  grid.X_WI.translation() = (low.array() - margin * voxel_mm).round();
  grid.X_WI.linear() = static_cast<double>(static_cast<float>(voxel_mm)) * Eigen::Matrix3d::Identity();
  for (int axis = 0; axis < 3; ++axis)
    grid.size[static_cast<std::size_t>(axis)] =
        static_cast<std::int64_t>((high[axis] - grid.X_WI.translation()[axis]) / voxel_mm) + margin;
  std::vector<std::uint8_t> labels(static_cast<std::size_t>(grid.size[0] * grid.size[1] * grid.size[2]));
  VoxelGrid in_joint = grid;
  in_joint.X_WI = lps_from_joint.transpose() * grid.X_WI;
  const auto mark = [&](const TriMesh& bone, std::uint8_t label) {
    const VoxelMask mask = mesh::voxelised(bone, in_joint);
    std::size_t in_box = 0;
    for (std::int64_t k = 0; k < mask.size[2]; ++k)
      for (std::int64_t j = 0; j < mask.size[1]; ++j) {
        const std::int64_t row = ((k + mask.first[2]) * grid.size[1] + j + mask.first[1]) * grid.size[0];
        for (std::int64_t i = 0; i < mask.size[0]; ++i)
          if (mask.inside[in_box++] != 0) labels[static_cast<std::size_t>(row + i + mask.first[0])] = label;
      }
  };
  mark(hip.femur, side == Side::left ? 75 : 76);
  mark(hip.hip_bone, side == Side::left ? 77 : 78);
  io::write_labels(out.file("labels.nii.gz"), grid, labels);
}

void write_sample_cartilages(OutputFolder& out, const sample::SampleCartilages& cartilages, Side side) {
  const BodyFile acetabular = {"acetabular cartilage", "acetabular_cartilage.ply"};
  const BodyFile femoral = {"femoral cartilage", "femoral_cartilage.ply"};
  write_mesh(out.file(acetabular.mesh), cartilages.acetabular);
  write_mesh(out.file(femoral.mesh), cartilages.femoral);
  const std::string name = fmt::format("cartilages of the sample {} hip", name_of(side));
  io::write_whole_file(out.file("cartilages.toml"), joint_file_text(name, acetabular, femoral, side));
}

}  // namespace condyle::io
