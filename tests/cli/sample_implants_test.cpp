#include "command.hpp"
#include "condyle/io/joint_file.hpp"
#include "condyle/sample/hip.hpp"

namespace condyle::test {
namespace {

class SampleReplacementCommand : public CommandTest {};
class SampleReverseShoulder : public CommandTest {};
class SampleImplants : public CommandTest {};

TEST_F(SampleReplacementCommand, WritesTheMeshesThatTheLibraryMakesWithTheSizesInTheJointFile) {
  done(
      "sample replacement --inclination 45 --anteversion 20 --definition anatomic --neck-shaft 130 "
      "--head-radius 18 --neck-taper 2 --facets 120 --side left --out made");
  plan::TotalHip hip;
  hip.cup = {Angle::degrees(45), Angle::degrees(20), CupDefinition::anatomic};
  hip.neck_shaft = Angle::degrees(130), hip.head_radius_mm = 18, hip.neck_taper = Angle::degrees(2);
  hip.facets = 120;
  const plan::ImplantMeshes expected =
      *sample::sample_replacement(hip, {}, sample::Scenario::one, Side::left);
  for (const auto* body : {&expected.fixed, &expected.mobile})
    for (const auto& [part, mesh] : *body)
      EXPECT_EQ(io::read_mesh(folder / ("made/" + part + ".ply")).mesh, mesh) << part;
  const io::JointFile file = io::read_joint_file(folder / "made/hip.toml");
  ASSERT_TRUE(file.implant);
  EXPECT_EQ(std::get<plan::TotalHip>(*file.implant), hip);
  EXPECT_EQ(file.joint.side, Side::left);
  EXPECT_EQ(file.uncertainty.centre_mm, 0);
  EXPECT_EQ(file.uncertainty.surface_mm, 0);
}

TEST_F(SampleReplacementCommand, HasBandsOfItsAxesInWhichTheHeadNeverMeetsTheLiner) {
  done("sample replacement --bones none --facets 120 --out made");
  const Json motion = answer("rom made/hip.toml --motion flexion --band=20")["motions"][0];
  // Axes 1 degree off about each of the three turn a limit by some degrees, cups of 4 and stems of 2 by more; a head in its liner would
  // end it anywhere.
  EXPECT_GT(motion["band"]["p5_deg"], motion["limit_deg"].get<double>() - 20);
  EXPECT_EQ(motion["band"]["width_from"]["centre_deg"], 0);
  EXPECT_LT(motion["band"]["width_from"]["axes_deg"], 8);
  EXPECT_GT(motion["band"]["width_from"]["parameters_deg"], motion["band"]["width_from"]["axes_deg"]);
}

TEST_F(SampleReplacementCommand, NamesThePartsThatEndMotions) {
  done("sample replacement --out made");
  const Ran rom = done("rom made/hip.toml");
  EXPECT_TRUE(says(rom.out, "neck on liner: flexion"));
  EXPECT_TRUE(says(rom.out, "femur on hip_bone: adduction"));
}

TEST_F(SampleReplacementCommand, RefusesWrongSizesInOneLineAndWritesNothing) {
  for (const auto& [arguments, line] :
       {std::pair("replacement --head-radius 28",
                  "condyle: implant: a head of radius 28 mm is too large for a cup of radius 27 mm outside: "
                  "its wall "
                  "needs 1 mm\n"),
        std::pair("replacement --neck-radius nan",
                  "condyle: implant: neck_radius is nan, must be 2 to 20 mm\n"),
        std::pair("replacement --cup-radius 29 --offset 50",
                  "condyle: sample replacement: a cup of radius 29 mm is not inside the pelvis: the socket "
                  "has 27.5 mm\n"),
        std::pair("reverse-shoulder --pillar-length 22",
                  "condyle: implant: the neck ends 22 mm from the centre of the head, too near to a cup of "
                  "radius 25 mm "
                  "outside: it must end 2 mm beyond, by a larger pillar_length\n")}) {
    const Ran ran = run(std::string("sample ") + arguments + " --out made");
    EXPECT_EQ(ran.exit_code, 2);
    EXPECT_EQ(ran.err, line);
    EXPECT_FALSE(fs::exists(here / "made"));
  }
}

TEST_F(SampleReverseShoulder, IsAShoulderWithItsSizesInTheJointFile) {
  done("sample reverse-shoulder --retroversion 25 --out made");
  const io::JointFile file = io::read_joint_file(folder / "made/shoulder.toml");
  EXPECT_EQ(file.joint.anatomy, Anatomy::shoulder);
  plan::ReverseShoulder expected;
  expected.retroversion = Angle::degrees(25);
  ASSERT_TRUE(file.implant);
  EXPECT_EQ(std::get<plan::ReverseShoulder>(*file.implant), expected);
}

/// A head on the scapula is what makes a shoulder reverse, and facets stand out of a sphere by hundredths of a millimetre.
TEST_F(SampleImplants, HaveNothingThatLooksWrong) {
  for (const char* sample : {"replacement", "replacement --bones none --side left", "reverse-shoulder"}) {
    done(std::string("sample ") + sample + " --out made");
    const char* joint = fs::exists(folder / "made/hip.toml") ? "made/hip.toml" : "made/shoulder.toml";
    EXPECT_EQ(answer(std::string("rom --strict ") + joint)["notes"], Json::array()) << sample;
    fs::remove_all(here / "made");
  }
}

}  // namespace
}  // namespace condyle::test
