#include "scenes.hpp"

#include <array>
#include <cmath>
#include <filesystem>
#include <utility>

#include "condyle/io/mesh_file.hpp"
#include "condyle/sample/cartilages.hpp"
#include "condyle/sample/hip.hpp"
#include "mesh/subdivide.hpp"
#include "real_data.hpp"
#include "scene_poses.hpp"
#include "support/test_meshes.hpp"

namespace bench {
namespace {

namespace fs = std::filesystem;
using condyle::Angle;
using condyle::Side;
using condyle::TriMesh;
using condyle::Vec3;

constexpr std::array<SceneName, 24> names = {{
    {"sample_1", "sample bones", "sample_bones"},
    {"sample_2", "sample bones", "sample_bones"},
    {"sample_3", "sample bones", "sample_bones"},
    {"sample_4", "sample bones", "sample_bones"},
    {"libhip_1", "real bones", "real_bones"},
    {"libhip_2", "real bones", "real_bones"},
    {"libhip_3", "real bones", "real_bones"},
    {"libhip_4", "real bones", "real_bones"},
    {"libhip_5", "real bones", "real_bones"},
    {"hip_libhip_m1_left", "hip_libhip_m1_left", "whole_hips"},
    {"hip_vhf_right", "hip_vhf_right", "whole_hips"},
    {"hip_vhf_right_x4", "hip_vhf_right", "whole_hips"},
    {"sample_5", "sample cartilages", "cartilages"},
    {"sample_6", "sample cartilages", "cartilages"},
    {"sample_7", "sample cartilages", "cartilages"},
    {"sample_8", "sample cartilages", "cartilages"},
    {"libhip_cartilage_gap", "real cartilages apart", "cartilages"},
    {"libhip_cartilage_nogap", "real cartilages touching", "cartilages"},
    {"ball_1mm_1", "ball, 1 mm", "balls"},
    {"ball_1mm_4", "ball, 1 mm", "balls"},
    {"ball_0.1mm_1", "ball, 0.1 mm", "balls"},
    {"ball_0.1mm_4", "ball, 0.1 mm", "balls"},
    {"ball_0mm_1", "ball, 0 mm", "balls"},
    {"ball_0mm_4", "ball, 0 mm", "balls"},
}};

/// Where a hip's socket is deepest: up, and inwards.
Vec3 into_hip_socket(Side side) {
  return Vec3(0, 1, side == Side::right ? -1 : 1).normalized();
}

condyle::Joint joint(std::string_view name, Side side, condyle::Body fixed, condyle::Body mobile) {
  return {std::string(name), condyle::JointKind::ball, side, std::move(fixed), std::move(mobile)};
}

condyle::Body body_from(const char* name, const fs::path& file) {
  return {name, condyle::io::read_mesh(file).mesh};
}

TriMesh refined(TriMesh mesh, int times) {
  for (int i = 0; i < times; ++i) mesh = condyle::mesh::subdivided(mesh);
  return mesh;
}

int size_of(std::string_view name) {
  return name.back() - '0';
}

/// All resolutions in the poses of the coarsest, which are made from its first contacts.
Scene sample_bones(std::string_view name) {
  condyle::sample::SampleHip hip = condyle::sample::sample_hip({}, condyle::sample::Scenario::one);
  std::vector<ScenePose> poses = poses_to_contact(hip.hip_bone, hip.femur);
  const auto scenario = static_cast<condyle::sample::Scenario>(size_of(name));
  if (scenario != condyle::sample::Scenario::one) hip = condyle::sample::sample_hip({}, scenario);
  return {joint(name, Side::right, {"hip bone", std::move(hip.hip_bone)}, {"femur", std::move(hip.femur)}),
          std::move(poses)};
}

/// Apart by the sample's own clearance.
Scene sample_cartilages(std::string_view name) {
  const condyle::sample::CartilageParameters cartilage;
  condyle::sample::SampleCartilages made = condyle::sample::sample_cartilages(
      {}, cartilage, static_cast<condyle::sample::CartilageScenario>(size_of(name)));
  return {joint(name, Side::right, {"acetabular cartilage", std::move(made.acetabular)},
                {"femoral cartilage", std::move(made.femoral)}),
          poses_in_socket(cartilage.clearance_mm, into_hip_socket(Side::right), Angle::degrees(40))};
}

Scene real_bones(std::string_view name, Side side, const fs::path& hip_bone, const fs::path& femur,
                 int refinements) {
  condyle::Body fixed = body_from("hip bone", hip_bone), mobile = body_from("femur", femur);
  std::vector<ScenePose> poses = poses_to_contact(fixed.mesh, mobile.mesh);
  fixed.mesh = refined(std::move(fixed.mesh), refinements);
  mobile.mesh = refined(std::move(mobile.mesh), refinements);
  return {joint(name, side, std::move(fixed), std::move(mobile)), std::move(poses)};
}

Scene real_cartilages(std::string_view name, const fs::path& folder, const std::string& ending,
                      double clearance_mm) {
  return {
      joint(name, Side::left, body_from("acetabular cartilage", folder / ("acetabular_cartilage_" + ending)),
            body_from("femoral cartilage", folder / ("femur_cartilage_" + ending))),
      poses_in_socket(clearance_mm, into_hip_socket(Side::left), Angle::degrees(40))};
}

/// A ball of 25 mm, as many triangles about as the bones of that size.
Scene ball_in_socket(std::string_view name, double clearance_mm) {
  constexpr double radius_mm = 25, socket_thickness_mm = 5;
  const int levels = size_of(name) + 3;
  const double inner = radius_mm + clearance_mm;
  return {joint(name, Side::right,
                {"socket", condyle::test::socket({0, 0, 0}, inner, inner + socket_thickness_mm, levels)},
                {"ball", condyle::test::sphere({0, 0, 0}, radius_mm, levels)}),
          poses_in_socket(clearance_mm, Vec3::UnitY(), Angle::degrees(180))};
}

Scene ball_scene(std::string_view name) {
  if (name.starts_with("ball_1mm")) return ball_in_socket(name, 1);
  if (name.starts_with("ball_0.1mm")) return ball_in_socket(name, 0.1);
  return ball_in_socket(name, 0);
}

Scene real_scene(std::string_view name, const fs::path& data) {
  const fs::path libhip = data / "hip_libhip_m1_left", vhf = data / "hip_vhf_right";
  // The smallest distance between the cartilages, from the data's own description.
  constexpr double cartilage_gap_mm = 0.1186;
  if (name == "libhip_cartilage_gap") return real_cartilages(name, libhip, "gap.ply", cartilage_gap_mm);
  if (name == "libhip_cartilage_nogap") return real_cartilages(name, libhip, "nogap.ply", 0);
  if (name.starts_with("hip_vhf_right"))
    return real_bones(name, Side::right, vhf / "hip_bone.ply", vhf / "femur.ply",
                      name.ends_with("x4") ? 1 : 0);
  if (name == "hip_libhip_m1_left")
    return real_bones(name, Side::left, libhip / "hip_bone.ply", libhip / "femur.ply", 0);
  return real_bones(name, Side::left, libhip / "coarse" / "hip_bone_2442.ply",
                    libhip / "coarse" / "femur_1542.ply", size_of(name) - 1);
}

}  // namespace

std::span<const SceneName> scene_names() {
  return names;
}

std::optional<Scene> make_scene(std::string_view name) {
  if (name.starts_with("sample_")) return size_of(name) < 5 ? sample_bones(name) : sample_cartilages(name);
  if (name.starts_with("ball_")) return ball_scene(name);
  const fs::path data = data_folder();
  if (!fs::is_directory(data / (name.find("vhf") != name.npos ? "hip_vhf_right" : "hip_libhip_m1_left")))
    return std::nullopt;
  return real_scene(name, data);
}

condyle::Points deformed(condyle::PointsView fixed_vertices, int frame) {
  constexpr double height_mm = 0.25, wave_mm = 60;
  condyle::Points out(fixed_vertices.size());
  for (std::size_t i = 0; i < out.size(); ++i) {
    const Vec3 p = fixed_vertices[i];
    const double phase = 2.4 * frame;
    const auto wave = [&](double along) { return std::sin(condyle::two_pi * along / wave_mm + phase); };
    out.set(i, p + height_mm / std::sqrt(3.0) * Vec3(wave(p.y()), wave(p.z()), wave(p.x())));
  }
  return out;
}

}  // namespace bench
