#include "command.hpp"
#include "condyle/answer.hpp"
#include "condyle/io/joint_file.hpp"

/// `condyle implant` says what answer_implant() answers, and writes a joint on which every command runs.

namespace condyle::test {
namespace {

class ImplantCommand : public CommandTest {
 protected:
  void SetUp() override { sample_into(here, "hip --scenario 1"); }
};

TEST_F(ImplantCommand, SaysWhatTheLibraryAnswers) {
  const std::string asked = "implant hip.toml --inclination 45 --definition anatomic --offset 42";
  const Json json = answer(asked);
  const Ran text = run(asked);
  const io::LoadedJoint loaded = io::read_joint(folder / "hip.toml");
  ImplantRequest request;
  request.hip.cup = {Angle::degrees(45), Angle::degrees(15), CupDefinition::anatomic};
  request.hip.offset_mm = 42, request.of_bones.offset = false;
  const ImplantAnswer expected = answer_implant(loaded, request);
  EXPECT_EQ(json["implant"]["neck_shaft_deg"].get<double>(),
            std::round(expected.hip.neck_shaft.degrees() * 100) / 100);
  EXPECT_EQ(json["implant"]["cup_radius_mm"], expected.hip.cup_radius_mm);
  EXPECT_EQ(json["of_bones"], Json({"neck_shaft", "stem_version", "cup_radius"}));
  EXPECT_EQ(json["cut"]["removed_mm3"], expected.removed_mm3);
  EXPECT_EQ(json["room_mm"], expected.room_mm);
  EXPECT_NEAR(json["cup"]["anatomic"]["inclination_deg"], 45, 1e-9);
  EXPECT_EQ(json["half_angle_deg"], expected.pair->half_angle.degrees());
  ASSERT_EQ(json["implant_notes"].size(), expected.notes.size());
  std::string notes;
  for (std::size_t i = 0; i < expected.notes.size(); ++i) {
    EXPECT_EQ(json["implant_notes"][i]["text"], expected.notes[i].text);
    EXPECT_FALSE(says(text.out, expected.notes[i].text));
    notes += fmt::format("condyle: note: {}: {}\n", name_of(expected.notes[i].code), expected.notes[i].text);
  }
  EXPECT_EQ(text.err, notes);
}

TEST_F(ImplantCommand, WritesAJointThatHasTheClosedFormAndTurnsItsParts) {
  done("implant hip.toml --out thr");
  for (const char* name : {"implant.json", "hip.toml", "fixed_bone.ply", "mobile_bone.ply", "liner.ply",
                           "head.ply", "neck.ply", "stem.ply"})
    EXPECT_TRUE(fs::exists(folder / "thr" / name)) << name;
  for (const char* set : {"", " --set \"cup.inclination=42 stem.version=10\""}) {
    const Json rom = answer(std::string("rom thr/hip.toml") + set);
    std::size_t on_liner = 0;
    for (const Json& motion : rom["motions"])
      if (motion["reason"] == "contact" && motion["features"]["mobile"]["part"] == "neck") {
        EXPECT_NEAR(motion["limit_deg"], motion["closed_form"]["limit_deg"], 0.01) << motion["motion"];
        ++on_liner;
      }
    EXPECT_GE(on_liner, 3u) << set;
  }
}

TEST_F(ImplantCommand, MeasuresOfTheJointSayThatTheyAreOfItsParts) {
  done("implant hip.toml --out thr");
  const Json measured = answer("measure thr/hip.toml");
  std::size_t with_value = 0;
  for (const Json& measure : measured["measures"]) {
    const std::string note = measure["note"].is_null() ? "" : measure["note"].get<std::string>();
    EXPECT_EQ(note.find("of the implant's parts") != std::string::npos, !measure["value"].is_null())
        << measure["key"];
    with_value += !measure["value"].is_null();
  }
  EXPECT_GT(with_value, 0u);
  EXPECT_FALSE(says(answer("measure hip.toml").dump(), "of the implant"));
}

TEST_F(ImplantCommand, KeepsTheMotionsOfTheJointFile) {
  done("implant hip.toml --out thr");
  const io::JointFile file = io::read_joint_file(folder / "thr/hip.toml");
  ASSERT_TRUE(file.implant);
  EXPECT_EQ(file.uncertainty.centre_mm, 0);
  EXPECT_EQ(file.joint.planned, "with a total hip");
  // What is uncertain of the bones stays so.
  const io::JointFile before = io::read_joint_file(folder / "hip.toml");
  EXPECT_EQ(file.uncertainty.surface_mm, before.uncertainty.surface_mm);
  EXPECT_EQ(file.uncertainty.surface_voxels, before.uncertainty.surface_voxels);
  EXPECT_EQ(file.joint.parts.size(), 2u);
}

TEST_F(ImplantCommand, ABandMovesTheSurfacesOfBonesAndNoneOfTheImplant) {
  for (const double voxel : {0.0, 1.2}) {
    if (voxel > 0)
      append("hip.toml",
             fmt::format(
                 "\n[fixed.image]\nvoxel_i = [{0}, 0, 0]\nvoxel_j = [0, {0}, 0]\nvoxel_k = [0, 0, {0}]\n",
                 voxel));
    done(fmt::format("implant hip.toml --out thr_{}", voxel > 0));
    const std::string file = fmt::format("thr_{}/hip.toml", voxel > 0);
    EXPECT_EQ(io::read_joint_file(folder / file).fixed.image.has_value(), voxel > 0);
    const Json rom = answer("rom " + file + " --band=20");
    std::size_t of_bones = 0, of_implant = 0;
    for (const Json& motion : rom["motions"]) {
      if (motion["reason"] != "contact") continue;
      const double by_surface = motion["band"]["width_from"]["surface_deg"];
      const bool is_bone = motion["features"]["fixed"]["part"] == "hip bone";
      of_bones += is_bone, of_implant += !is_bone;
      if (is_bone) {
        EXPECT_GT(by_surface, 0.5) << motion["name"];
      } else {
        EXPECT_LT(by_surface, motion["band"]["width_from"]["parameters_deg"].get<double>()) << motion["name"];
      }
    }
    EXPECT_GE(of_bones, 2u);
    EXPECT_GE(of_implant, 3u);
  }
}

TEST_F(ImplantCommand, RefusesInOneLineAndWritesNothing) {
  done("implant hip.toml --out thr");
  for (const auto& [arguments, code, says] :
       {std::tuple{"hip.toml --as-rim --inclination 40", 2, "--inclination"},
        {"hip.toml --centre middle", 2, "--centre"},
        {"hip.toml --neck-shaft 170", 2, "neck_shaft is 170, must be 110 to 160 degrees"},
        {"hip.toml --head-radius 28 --cup-radius 30", 2, "a head of radius 28 mm does not fit"},
        {"thr/hip.toml", 2, "has an implant already"},
        {"missing.toml", 3, "missing.toml"}})
    expect_refusal(run(std::string("implant ") + arguments + " --out none"), code, says, arguments);
  EXPECT_FALSE(fs::exists(folder / "none"));
}

}  // namespace
}  // namespace condyle::test
