#include <cctype>

#include "command.hpp"
#include "condyle/angle.hpp"

/// Joints that translate, and joints other than the hip, on the command line.

namespace condyle::test {
namespace {

/// A shank hanging from the joint centre and a post behind it, which a knee's flexion meets.
class FreeJoint : public CommandTest {
 protected:
  void SetUp() override {
    io::write_mesh(here / "post.ply", post(0));
    io::write_mesh(here / "shank.ply", shank);
    write("knee.toml", text_of_joint(knee));
  }
  static TriMesh post(double forwards) { return box({-60 + forwards, -120, -50}, {-40 + forwards, -80, 50}); }
  Json flexion(const std::string& joint, const std::string& arguments = "") const {
    return answer("rom " + joint + " --motion flexion" + arguments)["motions"][0];
  }

  const TriMesh shank = box({-1, -100, -2}, {1, -10, 2});
  const JointOfFile knee{.mobile = "shank.ply", .kind = "free", .name = "knee", .joint = "knee"},
      ball{.mobile = "shank.ply", .name = "knee", .joint = "knee"};
};

TEST_F(FreeJoint, AHeldTranslationIsAPostThatMuchNearer) {
  io::write_mesh(folder / "nearer.ply", post(10));
  JointOfFile nearer = ball;
  nearer.fixed = "nearer.ply";
  write("ball.toml", text_of_joint(nearer));
  const Json held = flexion("knee.toml", " --translation x=-10"), of_ball = flexion("ball.toml");
  EXPECT_EQ(held["reason"], "contact");
  EXPECT_EQ(held["limit_deg"], of_ball["limit_deg"]);
  EXPECT_EQ(held["features"], of_ball["features"]);
  // In the frame of the fixed body, the contact is where the post of the file has it.
  for (const int i : {0, 1, 2})
    EXPECT_EQ(held["contact_point_mm"][i].get<double>(),
              of_ball["contact_point_mm"][i].get<double>() + (i == 0 ? -10 : 0));
  EXPECT_LT(held["limit_deg"].get<double>(), flexion("knee.toml")["limit_deg"].get<double>());
}

TEST_F(FreeJoint, TheTranslationOfTheReferencePoseIsHeldUnlessToldOtherwise) {
  write("placed.toml", text_of_joint(knee) + "[reference_pose]\nx = -10\n");
  // The shank, given 10 mm behind, is 10 mm before its origin in its own frame: the joint is the one given.
  const Json rom = answer("rom placed.toml --motion flexion");
  EXPECT_EQ(rom["held_translation_mm"], Json({-10.0, 0.0, 0.0}));
  EXPECT_EQ(rom["anatomy"], "knee");
  EXPECT_EQ(answer("rom placed.toml --motion flexion --translation x=0")["held_translation_mm"],
            Json({0.0, 0.0, 0.0}));
  EXPECT_TRUE(says(run("rom placed.toml --motion flexion").out, "translation held at x -10, y 0, z 0 mm"));
}

TEST_F(FreeJoint, AHeldTranslationIsRefusedWhereItMakesNoSense) {
  write("ball.toml", text_of_joint(ball));
  write_edited("axes.toml", "knee.toml", "side", "translation_frame = \"joint_axes\"\nside");
  expect_refused(2, "rom ball.toml --translation x=1", "translation: only a free joint translates");
  expect_refused(2, "rom knee.toml --translation flexion=1", "--translation: takes x, y and z only");
  expect_refused(2, "rom axes.toml --translation x=1", "it would turn with them");
}

TEST_F(FreeJoint, DepthAtATranslatedPoseIsThatOfTheMeshMovedThere) {
  const std::string pose = " --pose \"flexion=30 x=3 y=4\" --method radial";
  const Json translated = answer("depth knee.toml" + pose);
  EXPECT_TRUE(translated["in_contact"].get<bool>());
  EXPECT_EQ(translated["pose_deg"]["flexion"], 30.0);
  EXPECT_EQ(translated["translation_mm"], Json({3.0, 4.0, 0.0}));
  EXPECT_EQ(translated["X_FM"][0][3], 3.0);
  EXPECT_EQ(translated["caveats"].size(), 1u);

  // X_FM is R_z(-30) with (3, 4, 0): the posed shank as a mesh of its own meets the same triangles.
  Pose X_FM(Eigen::AngleAxisd(-Angle::degrees(30).radians(), Vec3::UnitZ()));
  X_FM.pretranslate(Vec3(3, 4, 0));
  io::write_mesh(folder / "shank.ply", posed(X_FM, shank));
  const Json moved = answer("depth knee.toml --method radial");
  EXPECT_EQ(moved["triangle_pairs"], translated["triangle_pairs"]);
  EXPECT_EQ(moved["mobile_vertices_inside"], translated["mobile_vertices_inside"]);
  EXPECT_NEAR(moved["nearest_distance_mm"], translated["nearest_distance_mm"], 1e-12);
}

TEST_F(FreeJoint, AMatrixInAFileOrOnTheLineIsThePoseByItsCoordinates) {
  write("pose.txt", "0 1 0 -35\n-1 0 0 4\n0 0 1 0\n0 0 0 1\n");
  const Json named = answer("depth knee.toml --method radial --pose \"flexion=90 x=-35 y=4\"");
  Json by_file = answer("depth knee.toml --method radial --matrix pose.txt");
  Json by_line = answer("depth knee.toml --method radial --pose \"0 1 0 -35  -1 0 0 4  0 0 1 0  0 0 0 1\"");
  for (Json* given : {&by_file, &by_line}) (*given)["provenance"] = named["provenance"];
  EXPECT_EQ(by_file, named);
  EXPECT_EQ(by_line, named);
}

TEST_F(FreeJoint, ABadMatrixFileIsNamed) {
  const std::string turned = "0 1 0 -35\n-1 0 0 4\n0 0 1 0\n";
  for (const auto& [text, complaint] : std::vector<std::pair<std::string, const char*>>{
           {"", "a matrix begins with a number"},
           {"flexion=90", "a matrix begins with a number"},
           {turned, "a matrix has 16 numbers, row by row, not 12"},
           {turned + "0 0 1e999 1", "'1e999' in the matrix is not a finite number"},
           {turned + "0 0 0x0 1", "'0x0' in the matrix is not a finite number"},
           {"1;0;0;0;0;1;0;0;0;0;1;0;0;0;0;1", "in the matrix is not a finite number"}}) {
    write("pose.txt", text);
    const Ran ran = run("depth knee.toml --matrix pose.txt");
    expect_refusal(ran, 3, complaint, text);
    EXPECT_TRUE(says(ran.err, "condyle: pose.txt: pose: "));
  }
  expect_refused(3, "depth knee.toml --matrix none.txt", "none.txt");
  EXPECT_NE(run("depth knee.toml --matrix pose.txt --pose flexion=1").exit_code, 0);
}

TEST_F(FreeJoint, ArcsAreNotToldWhereThePoseTranslates) {
  expect_refused(2, "depth knee.toml --method tangential --pose \"flexion=30 x=-3 y=4\"",
                 "the pose is translated from it by 5.000 mm");
  const Json rotated = answer("depth knee.toml --pose \"flexion=30\"");
  EXPECT_TRUE(rotated["caveats"].empty());
}

TEST_F(FreeJoint, MotionsOfAKneeAreListedByItsNames) {
  const Ran ran = run("rom knee.toml --list-motions");
  EXPECT_TRUE(says(ran.out, "internal_rotation_at_90_flexion"));
  EXPECT_FALSE(says(ran.out, "fadir"));
}

/// The members that say something: not those that are null.
Json said(const Json& json) {
  if (!json.is_structured()) return json;
  Json out = json.is_array() ? Json::array() : Json::object();
  for (const auto& [key, value] : json.items()) {
    if (value.is_null()) continue;
    json.is_array() ? out.push_back(said(value)) : void(out[key] = said(value));
  }
  return out;
}

void expect_nothing_of_a_hip(std::string text, const std::string& where) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
  for (const char* word : {"hip", "clock", "neck", "head", "fadir", "femor", "acetab"})
    EXPECT_FALSE(says(text, word)) << where << " speaks of " << word;
}

TEST_F(FreeJoint, AnAnklesResultsHaveItsNames) {
  write_edited("ankle.toml", "knee.toml", "kind = \"free\"\njoint = \"knee\"",
               "kind = \"ball\"\njoint = \"ankle\"");
  const Json whole = answer("rom ankle.toml --motion plantarflexion --past 5 --band=20 --out out");
  const Json motion = whole["motions"][0];
  EXPECT_TRUE(whole["clock_plane"].is_null());
  Json words = said(whole);
  words.erase("provenance");  // folders may have any name
  expect_nothing_of_a_hip(words.dump(), "rom.json");
  EXPECT_EQ(motion["vary"], "dorsiflexion");
  EXPECT_EQ(motion["sense"], "negative");
  EXPECT_TRUE(motion["start_deg"].contains("inversion"));
  EXPECT_TRUE(motion["clock_hour"].is_null());
  EXPECT_TRUE(motion["normal_range_deg"].is_null()) << "the ranges known are those of a hip";
  const std::string text = text_of("out/limits.csv");
  const std::vector<std::string> lines = lines_of(text);
  ASSERT_EQ(lines.size(), 2u);
  for (const std::string& line : lines) expect_nothing_of_a_hip(line, "limits.csv");
  EXPECT_EQ(fields_of(lines[0]).size(), fields_of(lines[1]).size());
  const Ran reported = run("rom ankle.toml --motion plantarflexion --past 5");
  EXPECT_TRUE(says(reported.out, "every contact counts"));
  expect_nothing_of_a_hip(reported.out, "the text");
  EXPECT_TRUE(says(text, "start_dorsiflexion_deg,start_inversion_deg,start_internal_rotation_deg"));
  const Ran map = done("rom ankle.toml --map inversion=-5:5:5 internal_rotation=0:10:5 --out map");
  const Json grid = json_of("map/rom.json")["map"];
  EXPECT_EQ(grid["vary"], "dorsiflexion");
  EXPECT_EQ(grid["vary_opposite"], "plantarflexion");
}

/// A shank of two bars side by side, of which the second reaches as far as the post.
class Parts : public FreeJoint {
 protected:
  void SetUp() override {
    FreeJoint::SetUp();
    io::write_mesh(folder / "upper.ply", box({-1, -60, -2}, {1, -10, 2}));
    io::write_mesh(folder / "lower.ply", box({-1, -100, -2}, {1, -70, 2}));
    JointOfFile parts = knee;
    parts.mobile =
        "name = \"shank\"\nmeshes = [{ name = \"upper\", mesh = \"upper.ply\" }, "
        "{ name = \"lower\", mesh = \"lower.ply\" }]";
    write("parts.toml", text_of_joint(parts));
  }
};

TEST_F(Parts, TheWitnessOfALimitIsOfAPart) {
  const Json whole = flexion("knee.toml"), parts = flexion("parts.toml");
  EXPECT_NEAR(parts["limit_deg"], whole["limit_deg"], 1e-9);
  EXPECT_EQ(parts["features"]["mobile"]["part"], "lower");
  EXPECT_FALSE(parts["features"]["fixed"].contains("part"));
  EXPECT_FALSE(whole["features"]["mobile"].contains("part"));
}

TEST_F(Parts, DepthsNameTheirPart) {
  const Ran ran = done("depth parts.toml --pose flexion=30 --out out --csv");
  EXPECT_TRUE(says(ran.out, " of lower)"));
  const Json depth = json_of("out/depth.json");
  EXPECT_EQ(depth["reliable_depth"]["part"]["name"], "lower");
  // The vertices of the upper bar, 8 of them, come first.
  EXPECT_EQ(depth["reliable_depth"]["part"]["vertex"].get<int>(),
            depth["reliable_depth"]["vertex"].get<int>() - 8);
  EXPECT_TRUE(says(text_of("out/pairs.csv"), "fixed_triangle,mobile_triangle,fixed_part,mobile_part\n"));
  EXPECT_TRUE(says(text_of("out/pairs.csv"), ",,lower\n"));
  EXPECT_TRUE(says(text_of("out/mobile.csv"), ",part\n"));
  EXPECT_TRUE(says(text_of("out/mobile.vtp"), "Name=\"part\""));
  EXPECT_FALSE(says(text_of("out/fixed.vtp"), "Name=\"part\""));
}

}  // namespace
}  // namespace condyle::test
