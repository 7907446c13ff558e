#include "command.hpp"
#include "condyle/io/label_file.hpp"
#include "io/image/write_labels.hpp"
#include "whole_pelvis.hpp"

namespace condyle::test {
namespace {

/// A patient with two hips in one label map, islands beside them, and with one hip as meshes.
class Patients : public CommandTest {
 protected:
  void SetUp() override {
    sample_into(here, "hip --scenario 2 --voxel 2.5");
    auto [grid, labels] = with_mirror_image(io::read_labels(here / "labels.nii.gz"));
    const std::size_t island = 5000;
    for (std::size_t v = island; v < island + 3; ++v) labels[v] = 77;
    io::write_labels(here / "whole.nii.gz", grid, labels);
    for (std::uint8_t& label : labels)
      if (label != 0) label = label < 77 ? 2 : 1;
    io::write_labels(here / "unnamed.nii.gz", grid, labels);
  }
  bool is_there(const std::string& name) const { return fs::exists(here / name); }
};

TEST_F(Patients, GetBothHipsOfALabelMap) {
  const Ran ran = done("hip whole.nii.gz --task total --samples 0 --case \"Case 4\" --out patient");
  for (const std::string side : {"left", "right"}) {
    EXPECT_TRUE(says(text_of("patient/" + side + "/hip.toml"), "side = '" + side + "'"));
    EXPECT_EQ(json_of("patient/" + side + "/limits/rom.json")["side"], side);
    EXPECT_EQ(json_of("patient/" + side + "/measures/measures.json")["side"], side);
    EXPECT_TRUE(is_there("patient/" + side + "/hip.html"));
    // One command after another gives the same.
    const Json alone = answer("rom patient/" + side + "/hip.toml");
    const Json in_folder = json_of("patient/" + side + "/limits/rom.json");
    EXPECT_EQ(in_folder["motions"], alone["motions"]);
    EXPECT_EQ(in_folder["caveats"], alone["caveats"]);
    EXPECT_EQ(json_of("patient/" + side + "/measures/measures.json")["measures"],
              answer("measure patient/" + side + "/hip.toml")["measures"]);
  }
  // The left hip is the mirror image of the right one.
  EXPECT_TRUE(says(ran.out, "left (deg)"));
  EXPECT_TRUE(says(ran.out, "left - right"));
  EXPECT_TRUE(says(ran.out, "total arcs (deg), left and right: flexion to extension "));
  EXPECT_TRUE(says(ran.out, "zero is not known to be neutral, left and right"));
  const std::string table = text_of("patient/both.csv");
  EXPECT_TRUE(says(table, "motion,left_deg,left_p5_deg,left_p95_deg,right_deg,"));
  const Json left = json_of("patient/left/limits/rom.json")["motions"],
             right = json_of("patient/right/limits/rom.json")["motions"];
  for (std::size_t i = 0; i < left.size(); ++i)
    EXPECT_NEAR(left[i]["limit_deg"], right[i]["limit_deg"], 0.5) << left[i]["name"];
}

TEST_F(Patients, HaveBothFemoraInOneLabel) {
  const Ran ran =
      done("hip unnamed.nii.gz --fixed 1 --mobile 2 --samples 0 --sex male --verbose --out unnamed");
  EXPECT_TRUE(says(ran.err, "label_2 is in 2 pieces: the one on the left is kept"));
  EXPECT_EQ(json_of("unnamed/left/limits/rom.json")["side"], "left");
  EXPECT_EQ(json_of("unnamed/right/limits/rom.json")["side"], "right");
  EXPECT_TRUE(says(text_of("unnamed/right/hip.toml"), "\n[person]\nsex = \"male\"\n"));
}

TEST_F(Patients, OfMeshesHaveAPlanToo) {
  const Ran ran = done(
      "hip hip_bone.ply femur.ply --side right --samples 20 --age 30 --plan \"fadir=+5\" --confidence 0.6 "
      "--out planned");
  EXPECT_FALSE(is_there("planned/left"));
  EXPECT_FALSE(is_there("planned/both.csv"));
  const Json plan = json_of("planned/right/plan/resection.json");
  EXPECT_EQ(plan["targets"][0]["motion"], "fadir");
  EXPECT_TRUE(is_there("planned/right/planned.html"));
  for (const char* file : {"planned/right/hip.toml", "planned/right/plan/resected.toml"})
    EXPECT_TRUE(says(text_of(file), "\n[person]\nage = 30\n")) << file;
  EXPECT_TRUE(is_there("planned/right/plan/resected.toml"));
  // The limits of one hip are printed as condyle rom prints them; then what was planned.
  const std::string limits = run("rom planned/right/hip.toml --band=20").out;
  ASSERT_TRUE(ran.out.starts_with(limits)) << ran.out;
  EXPECT_TRUE(ran.out.substr(limits.size()).starts_with("  right: planned: without ")) << ran.out;
  EXPECT_GE(plan["targets"][0]["confidence_reached"], 0.6);
  EXPECT_TRUE(says(ran.out, ": " + plan["targets"][0]["text"].get<std::string>() + "\n"));
}

TEST_F(Patients, OfMeshesInAnotherUnitAreAnsweredWithANoteOnIt) {
  for (const char* name : {"hip_bone", "femur"}) {
    TriMesh mesh = io::read_mesh(here / (std::string(name) + ".ply")).mesh;
    for (std::vector<double>* row : {&mesh.vertices.x, &mesh.vertices.y, &mesh.vertices.z})
      for (double& value : *row) value /= 10;
    io::write_mesh(here / (std::string(name) + "_cm.ply"), mesh);
  }
  const std::string command = "hip hip_bone_cm.ply femur_cm.ply --side right --samples 0 --out ",
                    said = "meshes are taken to be in centimetres, ";
  EXPECT_TRUE(says(run(command + "inferred").err, said));
  EXPECT_FALSE(says(run(command + "stated --units cm").err, said));
}

/// A mesh of both hip bones is the half at the femur, of each.
TEST_F(Patients, HaveOneMeshOfBothHipBones) {
  const auto mirrored = [&](const char* file) {
    TriMesh mesh = io::read_mesh(here / file).mesh;
    for (double& z : mesh.vertices.z) z = -160 - z;
    for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
    return mesh;
  };
  const auto write_both = [&](const char* file, const char* of) {
    TriMesh both = io::read_mesh(here / of).mesh;
    const auto first = static_cast<Index>(both.vertices.size());
    const TriMesh left = mirrored(of);
    for (std::size_t v = 0; v < left.vertices.size(); ++v) both.vertices.push_back(left.vertices[v]);
    for (const Triangle& t : left.triangles)
      both.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
    io::write_mesh(here / file, both);
  };
  write_both("pelvis.ply", "hip_bone.ply");
  write_both("femora.ply", "femur.ply");
  io::write_mesh(here / "femur_left.ply", mirrored("femur.ply"));
  done("hip pelvis.ply femur_left.ply femur.ply --samples 0 --out one_mesh");
  for (const std::string side : {"left", "right"})
    EXPECT_TRUE(says(text_of("one_mesh/" + side + "/hip.toml"), "pieces = \"at_joint\""));
  const Json of_half = answer("rom one_mesh/right/hip.toml")["motions"],
             alone = answer("rom hip.toml")["motions"];
  for (std::size_t i = 0; i < alone.size(); ++i)
    EXPECT_NEAR(of_half[i]["limit_deg"], alone[i]["limit_deg"], 1.5)
        << alone[i]["name"] << ": the fitted centre is not that of the sample";
  // Both femora in one mesh are each its own side's.
  done("hip pelvis.ply femora.ply --samples 0 --out one_file");
  for (const std::string side : {"left", "right"})
    EXPECT_EQ(json_of("one_file/" + side + "/limits/rom.json")["motions"],
              json_of("one_mesh/" + side + "/limits/rom.json")["motions"]);
  done("hip pelvis.ply femora.ply --side left --samples 0 --out one_side");
  EXPECT_TRUE(is_there("one_side/left/hip.html") && !is_there("one_side/right"));
}

/// What is wrong with one hip keeps neither the other nor what is known of it from being answered.
TEST_F(Patients, AreAnsweredAsFarAsTheyCanBe) {
  const Ran ran = run("hip whole.nii.gz --task total --samples 0 --plan internal_rotation=+5 --out partly");
  EXPECT_EQ(ran.exit_code, 4);
  EXPECT_TRUE(says(ran.err, "left/hip.toml: resection: nothing ends internal_rotation"));
  EXPECT_TRUE(says(ran.out, "left - right"));
  EXPECT_TRUE(is_there("partly/right/hip.html") && is_there("partly/both.csv"));
}

TEST_F(Patients, ThatAreNotClearAreRefusedBeforeTheWork) {
  expect_refused(2, "hip whole.nii.gz --out x", "no label is called a hip bone or pelvis");
  expect_refused(2, "hip hip_bone.ply --out x", "FEMUR: the mesh of one femur is needed");
  expect_refused(2, "hip hip_bone.ply femur.ply --task total --out x", "--task: is for label maps");
  expect_refused(2, "hip hip_bone.ply femur.ply femur.ply --side right --out x", "--side: is for one femur");
  expect_refused(2, "hip hip_bone.ply femur.ply --side right --plan nonsense=3 --out y", "nonsense");
  fs::create_directory(here / "full");
  std::ofstream(here / "full" / "notes.txt") << "mine";
  expect_refused(3, "hip hip_bone.ply femur.ply --out full", "is there already");
  EXPECT_FALSE(is_there("x") || is_there("y"));
  expect_refused(4, "hip femur.ply hip_bone.ply --out z", "no joint file could be proposed: kind: ");
  EXPECT_FALSE(is_there("z"));
}

}  // namespace
}  // namespace condyle::test
