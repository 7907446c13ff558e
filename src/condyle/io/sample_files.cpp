#include "condyle/io/sample_files.hpp"

#include <fmt/format.h>

#include "condyle/io/mesh_file.hpp"
#include "condyle/io/pose_text.hpp"
#include "condyle/io/version.hpp"
#include "condyle/io/whole_file.hpp"

namespace condyle {
namespace {

std::string joint_file_text(Side side) {
  return fmt::format(R"(condyle = {}
name = "sample {} hip"
kind = "ball"
side = "{}"
units = "mm"

[fixed]
name = "hip bone"
mesh = "hip_bone.ply"

[mobile]
name = "femur"
mesh = "femur.ply"

[frame]
centre = [0.0, 0.0, 0.0]
anterior = [1.0, 0.0, 0.0]
superior = [0.0, 1.0, 0.0]
)",
                     format_version, name_of(side), name_of(side));
}

}  // namespace

void write_sample_hip(OutputFolder& out, const SampleHip& hip, Side side) {
  write_mesh(out.file("hip_bone.ply"), hip.hip_bone);
  write_mesh(out.file("femur.ply"), hip.femur);
  write_whole_file(out.file("hip.toml"), joint_file_text(side));
}

}  // namespace condyle
