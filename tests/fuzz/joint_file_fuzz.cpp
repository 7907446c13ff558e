#include <cmath>

#include "condyle/error.hpp"
#include "condyle/io/joint_file.hpp"
#include "condyle/io/mesh_file.hpp"
#include "condyle/joint_checks.hpp"
#include "fuzz/one_line.hpp"
#include "fuzz/targets.hpp"
#include "support/temporary_folder.hpp"
#include "support/test_meshes.hpp"

namespace condyle::test {
namespace {

/// Bones a joint file may name: a.ply, a socket, and b.ply, a head on a shaft.
const TemporaryFolder& folder_with_bones() {
  static const TemporaryFolder folder;
  static const bool written = [] {
    io::write_mesh(folder / "a.ply", socket(Vec3::Zero(), 26, 60, 2));
    io::write_mesh(folder / "b.ply",
                   joined(sphere(Vec3::Zero(), 24, 2), box({-10, -400, -10}, {10, -40, 10})));
    return true;
  }();
  static_cast<void>(written);
  return folder;
}

std::string fault_of(const io::JointFile& file) {
  if (file.fixed.meshes.empty() || file.mobile.meshes.empty()) return "a body without a mesh";
  for (const JointAngle angle : all_joint_angles) {
    if (!std::isfinite(file.reference_pose[angle])) return "an angle that is not finite";
  }
  return {};
}

std::string fault_of(const Joint& joint) {
  for (const Mesh* mesh : {&joint.fixed.mesh, &joint.mobile.mesh}) {
    if (mesh->triangles().empty()) return "a body without triangles";
  }
  for (const Ligament& ligament : joint.ligaments) {
    if (!(ligament.slack_length_mm > 0)) return "a ligament without a slack length";
    const auto state = ligament_state(ligament, Pose::Identity());
    if (state && !(state->length_mm >= 0 && state->strain >= -1 && state->tension_n >= 0))
      return "a ligament whose length is none";
  }
  return {};
}

}  // namespace

std::string fuzz_joint_file(std::string_view bytes) {
  const std::filesystem::path path = folder_with_bones().file("x.toml", bytes);
  try {
    if (std::string fault = fault_of(io::read_joint_file(path)); !fault.empty()) return fault;
    const io::LoadedJoint loaded = io::read_joint(path);
    for (const JointNote& note : check_ligaments(loaded.joint, loaded.report.placement))
      if (auto fault = fault_of_message(note.text); !fault.empty()) return fault;
    return fault_of(loaded.joint);
  } catch (const FileError& error) {
    return fault_of_message(error.what(), (folder_with_bones().path() / "").string());
  } catch (const MeshError& error) {
    return fault_of_message(error.what());
  }
}

}  // namespace condyle::test
