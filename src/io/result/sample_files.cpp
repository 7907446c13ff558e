#include "io/result/sample_files.hpp"

#include <fmt/format.h>

#include <string>

#include "condyle/io/mesh_file.hpp"
#include "condyle/io/pose_text.hpp"
#include "io/file/format_version.hpp"
#include "io/file/whole_file.hpp"

namespace condyle {
namespace {

struct BodyFile {
  const char *name, *mesh;
};

std::string joint_file_text(const std::string& joint, const BodyFile& fixed, const BodyFile& mobile,
                            Side side) {
  return fmt::format(R"(condyle = {}
name = "{}"
kind = "ball"
side = "{}"
units = "mm"

[fixed]
name = "{}"
mesh = "{}"

[mobile]
name = "{}"
mesh = "{}"

[frame]
centre = [0.0, 0.0, 0.0]
anterior = [1.0, 0.0, 0.0]
superior = [0.0, 1.0, 0.0]
)",
                     io::format_version, joint, name_of(side), fixed.name, fixed.mesh, mobile.name,
                     mobile.mesh);
}

}  // namespace

void write_sample_hip(OutputFolder& out, const SampleHip& hip, Side side) {
  const BodyFile hip_bone = {"hip bone", "hip_bone.ply"}, femur = {"femur", "femur.ply"};
  write_mesh(out.file(hip_bone.mesh), hip.hip_bone);
  write_mesh(out.file(femur.mesh), hip.femur);
  io::write_whole_file(out.file("hip.toml"),
                       joint_file_text(fmt::format("sample {} hip", name_of(side)), hip_bone, femur, side));
}

void write_sample_cartilages(OutputFolder& out, const SampleCartilages& cartilages, Side side) {
  const BodyFile acetabular = {"acetabular cartilage", "acetabular_cartilage.ply"};
  const BodyFile femoral = {"femoral cartilage", "femoral_cartilage.ply"};
  write_mesh(out.file(acetabular.mesh), cartilages.acetabular);
  write_mesh(out.file(femoral.mesh), cartilages.femoral);
  const std::string name = fmt::format("cartilages of the sample {} hip", name_of(side));
  io::write_whole_file(out.file("cartilages.toml"), joint_file_text(name, acetabular, femoral, side));
}

}  // namespace condyle
