#include "scenes.hpp"

#include <array>
#include <cstdlib>
#include <filesystem>
#include <utility>

#include "condyle/io/mesh_file.hpp"
#include "condyle/sample/hip.hpp"

namespace bench {
namespace {

namespace fs = std::filesystem;
using condyle::Angle;
using condyle::JointAngles;
using condyle::Side;

constexpr std::array<std::string_view, 6> names = {"sample_1", "sample_2",           "sample_3",
                                                   "sample_4", "hip_libhip_m1_left", "hip_vhf_right"};

constexpr JointAngles angles(double flexion, double adduction, double internal_rotation) {
  return {Angle::degrees(flexion), Angle::degrees(adduction), Angle::degrees(internal_rotation)};
}

constexpr std::array<JointAngles, 6> poses = {
    angles(0, 0, 0),     angles(90, 0, 0),    angles(140, 0, 0),
    angles(110, 15, 35), angles(-25, 0, -50), angles(0, -65, 0),
};

fs::path data_folder() {
  const char* named = std::getenv("CONDYLE_DATA");
  return named ? fs::path(named) : fs::path(CONDYLE_SOURCE_DIR).parent_path() / "shared" / "data";
}

condyle::Joint hip(std::string_view name, Side side, condyle::TriMesh hip_bone, condyle::TriMesh femur) {
  return {std::string(name),
          condyle::JointKind::ball,
          side,
          {"hip bone", std::move(hip_bone)},
          {"femur", std::move(femur)}};
}

}  // namespace

std::span<const std::string_view> scene_names() {
  return names;
}

std::optional<condyle::Joint> make_scene(std::string_view name) {
  if (name.starts_with("sample_")) {
    condyle::SampleHip sample = condyle::sample_hip({}, static_cast<condyle::Scenario>(name.back() - '0'));
    return hip(name, Side::right, std::move(sample.hip_bone), std::move(sample.femur));
  }
  const fs::path folder = data_folder() / name;
  if (!fs::is_directory(folder)) return std::nullopt;
  return hip(name, name.ends_with("left") ? Side::left : Side::right,
             condyle::read_mesh(folder / "hip_bone.ply").mesh, condyle::read_mesh(folder / "femur.ply").mesh);
}

std::span<const JointAngles> query_poses() {
  return poses;
}

}  // namespace bench
