#include <gtest/gtest.h>

#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "command.hpp"
#include "condyle/io/label_file.hpp"
#include "condyle/io/mesh_file.hpp"
#include "io/file/whole_file.hpp"
#include "io/image/write_labels.hpp"
#include "support/temporary_folder.hpp"
#include "whole_pelvis.hpp"

namespace condyle::test {
namespace {

using Json = nlohmann::json;
namespace fs = std::filesystem;

/// A patient with two hips in one label map, islands beside them, and with one hip as meshes.
class Patients : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    scan = std::make_unique<TemporaryFolder>();
    ASSERT_EQ(run_condyle(scan->path(), "sample hip --scenario 2 --voxel 2.5 --out .").exit_code, 0);
    auto [grid, labels] = with_mirror_image(io::read_labels(scan->path() / "labels.nii.gz"));
    const std::size_t island = 5000;
    for (std::size_t v = island; v < island + 3; ++v) labels[v] = 77;
    io::write_labels(scan->path() / "whole.nii.gz", grid, labels);
    for (std::uint8_t& label : labels)
      if (label != 0) label = label < 77 ? 2 : 1;
    io::write_labels(scan->path() / "unnamed.nii.gz", grid, labels);
  }
  static void TearDownTestSuite() { scan.reset(); }

  Ran run(const std::string& arguments) const { return run_condyle(scan->path(), arguments); }
  std::string text(const fs::path& name) const { return io::read_whole_file(scan->path() / name); }
  Json json(const fs::path& name) const { return Json::parse(text(name)); }
  bool is_there(const fs::path& name) const { return fs::exists(scan->path() / name); }

  static inline std::unique_ptr<TemporaryFolder> scan;
};

TEST_F(Patients, GetBothHipsOfALabelMap) {
  const Ran ran = run("hip whole.nii.gz --task total --samples 0 --case \"Case 4\" --out patient");
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  for (const std::string side : {"left", "right"}) {
    EXPECT_NE(text("patient/" + side + "/hip.toml").find("side = '" + side + "'"), std::string::npos);
    EXPECT_EQ(json("patient/" + side + "/limits/rom.json")["side"], side);
    EXPECT_EQ(json("patient/" + side + "/measures/measures.json")["side"], side);
    EXPECT_TRUE(is_there("patient/" + side + "/hip.html"));
    // One command after another gives the same.
    const Json alone = Json::parse(run("rom patient/" + side + "/hip.toml --json").out);
    const Json in_folder = json("patient/" + side + "/limits/rom.json");
    EXPECT_EQ(in_folder["motions"], alone["motions"]);
    EXPECT_EQ(in_folder["caveats"], alone["caveats"]);
    EXPECT_EQ(json("patient/" + side + "/measures/measures.json")["measures"],
              Json::parse(run("measure patient/" + side + "/hip.toml --json").out)["measures"]);
  }
  // The left hip is the mirror image of the right one.
  EXPECT_NE(ran.out.find("left (deg)"), std::string::npos) << ran.out;
  EXPECT_NE(ran.out.find("left - right"), std::string::npos) << ran.out;
  EXPECT_NE(ran.out.find("total arcs (deg), left and right: flexion to extension "), std::string::npos)
      << ran.out;
  EXPECT_NE(ran.out.find("zero is not known to be neutral, left and right"), std::string::npos) << ran.out;
  const std::string table = text("patient/both.csv");
  EXPECT_NE(table.find("motion,left_deg,left_p5_deg,left_p95_deg,right_deg,"), std::string::npos) << table;
  const Json left = json("patient/left/limits/rom.json")["motions"],
             right = json("patient/right/limits/rom.json")["motions"];
  for (std::size_t i = 0; i < left.size(); ++i)
    EXPECT_NEAR(left[i]["limit_deg"].get<double>(), right[i]["limit_deg"].get<double>(), 0.5)
        << left[i]["name"];
}

TEST_F(Patients, HaveBothFemoraInOneLabel) {
  const Ran ran = run("hip unnamed.nii.gz --fixed 1 --mobile 2 --samples 0 --sex male --verbose --out unnamed");
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  EXPECT_NE(ran.err.find("label_2 is in 2 pieces: the one on the left is kept"), std::string::npos)
      << ran.err;
  EXPECT_EQ(json("unnamed/left/limits/rom.json")["side"], "left");
  EXPECT_EQ(json("unnamed/right/limits/rom.json")["side"], "right");
  EXPECT_NE(text("unnamed/right/hip.toml").find("\n[person]\nsex = \"male\"\n"), std::string::npos);
}

TEST_F(Patients, OfMeshesHaveAPlanToo) {
  const Ran ran = run(
      "hip hip_bone.ply femur.ply --side right --samples 20 --age 30 --plan \"fadir=+5\" --confidence 0.6 "
      "--out planned");
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  EXPECT_FALSE(is_there("planned/left"));
  EXPECT_FALSE(is_there("planned/both.csv"));
  const Json plan = json("planned/right/plan/resection.json");
  EXPECT_EQ(plan["targets"][0]["motion"], "fadir");
  EXPECT_TRUE(is_there("planned/right/planned.html"));
  for (const char* file : {"planned/right/hip.toml", "planned/right/plan/resected.toml"})
    EXPECT_NE(text(file).find("\n[person]\nage = 30\n"), std::string::npos) << file;
  EXPECT_TRUE(is_there("planned/right/plan/resected.toml"));
  // The limits of one hip are printed as condyle rom prints them; then what was planned.
  const std::string limits = run("rom planned/right/hip.toml --band=20").out;
  ASSERT_TRUE(ran.out.starts_with(limits)) << ran.out;
  EXPECT_TRUE(ran.out.substr(limits.size()).starts_with("  right: planned: without ")) << ran.out;
  EXPECT_GE(plan["targets"][0]["confidence_reached"], 0.6);
  EXPECT_NE(ran.out.find(": " + plan["targets"][0]["text"].get<std::string>() + "\n"), std::string::npos)
      << ran.out;
}

TEST_F(Patients, OfMeshesInAnotherUnitAreAnsweredWithANoteOnIt) {
  for (const char* name : {"hip_bone", "femur"}) {
    TriMesh mesh = io::read_mesh(scan->path() / (std::string(name) + ".ply")).mesh;
    for (std::vector<double>* row : {&mesh.vertices.x, &mesh.vertices.y, &mesh.vertices.z})
      for (double& value : *row) value /= 10;
    io::write_mesh(scan->path() / (std::string(name) + "_cm.ply"), mesh);
  }
  const std::string command = "hip hip_bone_cm.ply femur_cm.ply --side right --samples 0 --out ",
                    said = "meshes are taken to be in centimetres, ";
  EXPECT_NE(run(command + "inferred").err.find(said), std::string::npos);
  EXPECT_EQ(run(command + "stated --units cm").err.find(said), std::string::npos);
}

/// A mesh of both hip bones is the half at the femur, of each.
TEST_F(Patients, HaveOneMeshOfBothHipBones) {
  const auto mirrored = [&](const char* file) {
    TriMesh mesh = io::read_mesh(scan->path() / file).mesh;
    for (double& z : mesh.vertices.z) z = -160 - z;
    for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
    return mesh;
  };
  const auto write_both = [&](const char* file, const char* of) {
    TriMesh both = io::read_mesh(scan->path() / of).mesh;
    const auto first = static_cast<Index>(both.vertices.size());
    const TriMesh left = mirrored(of);
    for (std::size_t v = 0; v < left.vertices.size(); ++v) both.vertices.push_back(left.vertices[v]);
    for (const Triangle& t : left.triangles)
      both.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
    io::write_mesh(scan->path() / file, both);
  };
  write_both("pelvis.ply", "hip_bone.ply");
  write_both("femora.ply", "femur.ply");
  io::write_mesh(scan->path() / "femur_left.ply", mirrored("femur.ply"));
  const Ran ran = run("hip pelvis.ply femur_left.ply femur.ply --samples 0 --out one_mesh");
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  for (const std::string side : {"left", "right"})
    EXPECT_NE(text("one_mesh/" + side + "/hip.toml").find("pieces = \"at_joint\""), std::string::npos);
  const Json of_half = Json::parse(run("rom one_mesh/right/hip.toml --json").out)["motions"],
             alone = Json::parse(run("rom hip.toml --json").out)["motions"];
  for (std::size_t i = 0; i < alone.size(); ++i)
    EXPECT_NEAR(of_half[i]["limit_deg"].get<double>(), alone[i]["limit_deg"].get<double>(), 1.5)
        << alone[i]["name"] << ": the fitted centre is not that of the sample";
  // Both femora in one mesh are each its own side's.
  ASSERT_EQ(run("hip pelvis.ply femora.ply --samples 0 --out one_file").exit_code, 0);
  for (const std::string side : {"left", "right"})
    EXPECT_EQ(json("one_file/" + side + "/limits/rom.json")["motions"],
              json("one_mesh/" + side + "/limits/rom.json")["motions"]);
  ASSERT_EQ(run("hip pelvis.ply femora.ply --side left --samples 0 --out one_side").exit_code, 0);
  EXPECT_TRUE(is_there("one_side/left/hip.html") && !is_there("one_side/right"));
}

/// What is wrong with one hip keeps neither the other nor what is known of it from being answered.
TEST_F(Patients, AreAnsweredAsFarAsTheyCanBe) {
  const Ran ran = run("hip whole.nii.gz --task total --samples 0 --plan internal_rotation=+5 --out partly");
  EXPECT_EQ(ran.exit_code, 4);
  EXPECT_NE(ran.err.find("left: resection: nothing ends internal_rotation"), std::string::npos) << ran.err;
  EXPECT_NE(ran.out.find("left - right"), std::string::npos) << ran.out;
  EXPECT_TRUE(is_there("partly/right/hip.html") && is_there("partly/both.csv"));
}

TEST_F(Patients, ThatAreNotClearAreRefusedBeforeTheWork) {
  expect_refusal(run("hip whole.nii.gz --out x"), 2, "no label is called a hip bone or pelvis", "no names");
  expect_refusal(run("hip hip_bone.ply --out x"), 2, "FEMUR: the mesh of one femur is needed", "no femur");
  expect_refusal(run("hip hip_bone.ply femur.ply --task total --out x"), 2, "--task: is for label maps",
                 "task");
  expect_refusal(run("hip hip_bone.ply femur.ply femur.ply --side right --out x"), 2,
                 "--side: is for one femur", "side");
  expect_refusal(run("hip hip_bone.ply femur.ply --side right --plan nonsense=3 --out y"), 2, "nonsense",
                 "plan");
  fs::create_directory(scan->path() / "full");
  std::ofstream(scan->path() / "full" / "notes.txt") << "mine";
  expect_refusal(run("hip hip_bone.ply femur.ply --out full"), 3, "is there already", "full");
  EXPECT_FALSE(is_there("x") || is_there("y"));
  expect_refusal(run("hip femur.ply hip_bone.ply --out z"), 4,
                 "no joint file could be proposed: kind: ", "exchanged");
  EXPECT_FALSE(is_there("z"));
}

}  // namespace
}  // namespace condyle::test
