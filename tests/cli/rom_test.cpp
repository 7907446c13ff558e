#include <sys/wait.h>

#include <cstdio>

#include "command.hpp"
#include "mesh/subdivide.hpp"

namespace condyle::test {
namespace {

/// An arm hanging from the joint centre and a post in front of it: flexion ends in closed form.
class RomCommand : public ArmAndPost {
 protected:
  void write_fine_meshes() const {
    for (const char* name : {"post.ply", "arm.ply"}) {
      TriMesh mesh = io::read_mesh(here / name).mesh;
      for (int level = 0; level < 5; ++level) mesh = mesh::subdivided(mesh);
      io::write_mesh(here / name, mesh);
    }
  }
  void expect_refused(int exit_code, const std::string& arguments, std::string_view saying) const {
    CommandTest::expect_refused(exit_code, arguments, saying);
    EXPECT_FALSE(fs::exists(here / "out")) << arguments;
  }

  static constexpr const char* small_map = " --map adduction=-10:10:5 internal_rotation=-20:20:10";
  /// With fine meshes more than a million points take many minutes on any machine: never finished here, however late
  /// the interruption comes on a busy one.
  static constexpr const char* long_map = " --map adduction=-30:30:0.05 internal_rotation=-30:30:0.05";
};

TEST_F(RomCommand, AnswersInTextAndJson) {
  const Ran text = done("rom joint.toml");
  EXPECT_EQ(text.err, "");
  EXPECT_TRUE(text.out.starts_with("arm and post: "));
  EXPECT_TRUE(says(text.out, "external_rotation_at_90_flexion"));

  const Json motions = answer("rom joint.toml --motion flexion --motion fadir")["motions"];
  ASSERT_EQ(motions.size(), 2u);
  EXPECT_EQ(motions[0]["name"], "flexion");
  EXPECT_EQ(motions[0]["reason"], "contact");
  // The arm's lower front edge, (1, -100), meets the post's wall x = 40. Limits are within 4e-12 rad of the
  // truth, 3e-10 degrees.
  const double limit = std::asin(40 / std::hypot(1, 100)) - std::atan2(1, 100);
  EXPECT_NEAR(motions[0]["limit_deg"], limit * 180 / std::acos(-1), 3e-10);
  EXPECT_EQ(motions[1]["name"], "fadir");
}

TEST_F(RomCommand, ReadsMotionsOfTheJointFile) {
  append("joint.toml", "[[motion]]\nname = \"half_way\"\nvary = \"flexion\"\nrange = [0, 10]\n");
  const Ran ran = done("rom joint.toml --motion half_way --json");
  EXPECT_EQ(Json::parse(ran.out)["motions"][0]["reason"], "end_of_range");
  expect_refused(2, "rom joint.toml --motion halfway", "half_way");
}

TEST_F(RomCommand, HoldsLimitsAgainstPeopleLikeTheOneOfTheFileOrOfItsOptions) {
  append("joint.toml", "[reference_pose]\n[person]\nage = 5\n");
  const auto people = [&](const std::string& options) {
    const Json people = answer("rom joint.toml --motion flexion" + options)["motions"][0]["living"]["people"];
    return std::array{people["low_deg"], people["high_deg"]};
  };
  EXPECT_EQ(people(""), (std::array<Json, 2>{131.1, 140.8}));
  EXPECT_EQ(people(" --sex female"), (std::array<Json, 2>{140.8, 140.8}));
  EXPECT_EQ(people(" --age 30"), (std::array<Json, 2>{120.0, 120.0}));
  expect_refused(2, "rom joint.toml --age 121", "--age: must be 0 to 120 years");
  expect_refused(2, "rom joint.toml --sex f", "--sex");
}

TEST_F(RomCommand, WritesEveryFileAndOnlyWhole) {
  const std::string command = std::string("rom joint.toml --out out --json") + small_map;
  const Ran ran = done(command);
  EXPECT_EQ(text_of("out/rom.json"), ran.out);
  for (const char* name : {"limits.csv", "map.csv", "map_intervals.csv", "map.vtp"})
    EXPECT_TRUE(fs::exists(here / "out" / name)) << name;
  EXPECT_EQ(Json::parse(ran.out)["map"]["points"], 25);
}

TEST_F(RomCommand, WritesZonesPastTheLimitsThatEndInContact) {
  append("joint.toml", "[[motion]]\nname = \"../up & down\"\nvary = \"flexion\"\nrange = [0, 10]\n");
  const Json motions =
      answer("rom joint.toml --motion flexion --motion '../up & down' --past 4 --out out")["motions"];
  EXPECT_EQ(motions[0]["zone"]["past_deg"].get<double>(), 4);
  // The post's wall x = 40 is two triangles, and the arm's corner stands in it.
  EXPECT_GT(motions[0]["zone"]["fixed"]["area_mm2"].get<double>(), 0);
  EXPECT_GT(motions[0]["zone"]["mobile"]["max_tangential_depth_deg"].get<double>(), 0);
  EXPECT_LE(motions[0]["zone"]["mobile"]["max_tangential_depth_deg"].get<double>(), 4 + 1e-9);
  EXPECT_TRUE(motions[1]["zone"].is_null());
  const TriMesh fixed = io::read_mesh(here / "out/zone_01_flexion_fixed.vtp").mesh;
  EXPECT_EQ(fixed, io::read_mesh(here / "post.ply").mesh);
  EXPECT_EQ(io::read_mesh(here / "out/zone_01_flexion_mobile.vtp").mesh.triangles,
            io::read_mesh(here / "arm.ply").mesh.triangles);
  const std::string bytes = text_of("out/zone_01_flexion_mobile.vtp");
  for (const char* name :
       {"radial_depth_mm", "ray_to_normal_deg", "tangential_depth_deg", "tangential_depth_mm", "in_zone"})
    EXPECT_TRUE(says(bytes, name)) << name;
  // The text has them too, a line for each.
  const std::string text = run("rom joint.toml --motion flexion --past 4").out;
  const std::size_t zones = text.find("  zones 4 deg past the limit");
  ASSERT_NE(zones, text.npos) << text;
  const Json& zone = motions[0]["zone"];
  const double deepest = std::max(zone["fixed"]["max_tangential_depth_mm"].get<double>(),
                                  zone["mobile"]["max_tangential_depth_mm"].get<double>());
  for (const auto& [value, decimals] :
       {std::pair(zone["fixed"]["area_mm2"].get<double>(), 1),
        std::pair(zone["mobile"]["area_mm2"].get<double>(), 1), std::pair(deepest, 2)}) {
    char number[40];
    std::snprintf(number, sizeof number, "%.*f", decimals, value);
    EXPECT_NE(text.find(number, zones), text.npos) << number << " in\n" << text;
  }
  EXPECT_FALSE(says(run("rom joint.toml --motion flexion").out, "zones"));
  // No file for the motion without contact, nor one outside the folder.
  for (const auto& entry : fs::recursive_directory_iterator(here))
    EXPECT_FALSE(says(entry.path().string(), "down")) << entry.path();
}

/// Otherwise a map of another question would stay beside the limits of this one.
TEST_F(RomCommand, WhatAnEarlierRunWroteIsReplaced) {
  write("notes.txt", "somebody's");
  done(std::string("rom joint.toml --motion flexion --past 4 --out .") + small_map);
  EXPECT_TRUE(fs::exists(here / "zone_01_flexion_fixed.vtp"));
  for (const char* drawn :
       {"limits.pdf", "limit_bands.png", "clock_face.png", "map_flexion.svg", "map_free_range.pdf"})
    write(drawn, "drawn of it");
  write("map_of_mine.pdf", "somebody's");
  const Ran ran = done("rom joint.toml --motion extension --out .");
  EXPECT_TRUE(says(ran.err, "wrote ./rom.json, ./limits.csv"));
  done("rom joint.toml --motion extension --out fresh");
  std::set<std::string> left,
      fresh = {"notes.txt", "map_of_mine.pdf", "joint.toml", "post.ply", "arm.ply", "fresh"};
  for (const auto& entry : fs::directory_iterator(here)) left.insert(entry.path().filename());
  for (const auto& entry : fs::directory_iterator(here / "fresh")) fresh.insert(entry.path().filename());
  EXPECT_EQ(left, fresh);
}

TEST_F(RomCommand, SaysWhereItComesFromInEveryFile) {
  const Json from = answer(std::string("rom --motion flexion --motion fadir --past 4 joint.toml --out out") +
                           small_map)["provenance"];
  EXPECT_EQ(from["command"],
            Json({"rom", "joint.toml", "--motion", "flexion", "--motion", "fadir", "--map",
                  "adduction=-10:10:5", "--map", "internal_rotation=-20:20:10", "--past", "4"}));
  const std::string sha = from["fixed_mesh"]["sha256"];
  for (const char* name : {"limits.csv", "map.csv"})
    EXPECT_TRUE(says(io::read_whole_file(here / "out" / name), sha)) << name;
  for (const char* name : {"zone_01_flexion_fixed.vtp", "zone_01_flexion_mobile.vtp"})
    EXPECT_TRUE(says(io::read_whole_file(here / "out" / name), "Name=\"fixed_mesh\"")) << name;
}

TEST_F(RomCommand, InTheSourceFramePointsAndZonesLieOnTheFiles) {
  for (const char* name : {"post.ply", "arm.ply"})
    io::write_mesh(here / name, shifted_by(io::read_mesh(here / name).mesh, {8, -4, 2}));
  edit("joint.toml", "[0, 0, 0]", "[8, -4, 2]");
  const std::string command = "rom joint.toml --motion flexion --past 4 --out out --json";
  const Json in_joint = Json::parse(run(command).out)["motions"][0];
  const Json in_source = Json::parse(run(command + " --frame source").out)["motions"][0];
  EXPECT_EQ(in_source["limit_deg"], in_joint["limit_deg"]);
  EXPECT_EQ(in_source["clock_hour"], in_joint["clock_hour"]);
  for (const char* key : {"contact_point_mm", "contact_point_mobile_mm"})
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_NEAR(in_source[key][k].get<double>() - in_joint[key][k].get<double>(), (std::array{8, -4, 2})[k],
                  1e-12);
  EXPECT_EQ(io::read_mesh(here / "out/zone_01_flexion_fixed.vtp").mesh,
            io::read_mesh(here / "post.ply").mesh);
}

TEST_F(RomCommand, AllowsADepthOnRequestAndSaysThatTheLimitIsSearchedFor) {
  const Json searched = answer("rom joint.toml --motion flexion --allow-depth 0.5");
  EXPECT_FALSE(searched["caveats"].empty());
  EXPECT_LE(searched["motions"][0]["depth"]["at_limit_mm"].get<double>(), 0.5);
  const Json exact = answer("rom joint.toml --motion flexion")["motions"][0];
  EXPECT_GE(searched["motions"][0]["limit_deg"], exact["limit_deg"]);
}

TEST_F(RomCommand, GivesTheSameBytesOnOneThreadAndOnMany) {
  for (const char* threads : {"1", "4"})
    done(std::string("rom joint.toml --threads ") + threads + " --out out" + threads + small_map);
  for (const auto& entry : fs::directory_iterator(here / "out1"))
    EXPECT_EQ(io::read_whole_file(entry.path()), io::read_whole_file(here / "out4" / entry.path().filename()))
        << entry.path();
}

TEST_F(RomCommand, WrongUsageIsOneLineAndExitCodeTwo) {
  expect_refused(2, "rom", "JOINT is required");
  expect_refused(2, "rom joint.toml --motion fadirr --out out",
                 "unknown motion \"fadirr\" (did you mean \"fadir\"?); there are flexion, extension, ");
  expect_refused(2, "rom joint.toml --out out --map flexion=10:0:1 adduction=0:1:1", "ends before it begins");
  expect_refused(2, "rom joint.toml --out out --map flexion=0:99999:1 adduction=0:9999:1",
                 "1000000000 points");
  expect_refused(2, "rom joint.toml --out out --map flexion=0:10:0 adduction=0:1:1", "step");
  expect_refused(2, "rom joint.toml --out out --map flexion=0:a:1 adduction=0:1:1", "'flexion=0:a:1'");
  expect_refused(2, "rom joint.toml --out out --map flexion adduction=0:1:1", "'flexion'");
  expect_refused(2, "rom joint.toml --out out --map tilt=0:1:1 adduction=0:1:1", "'tilt'");
  expect_refused(2, "rom joint.toml --out out --map flexion=0:1:1", "--map");
  expect_refused(2, "rom joint.toml --out out --map flexion=0:1:1 flexion=0:1:1", "named twice");
  expect_refused(2, "rom joint.toml --out out --map flexion=0:1:1 adduction=0:1:1 --vary flexion",
                 "named twice");
  expect_refused(2, "rom joint.toml --out out --vary flexion", "--vary");
  expect_refused(2, "rom joint.toml --out out --bearing -1", "0 mm or more");
  expect_refused(2, "rom joint.toml --out out --bearing most", "neither a margin in mm nor count");
  expect_refused(2, "rom joint.toml --out out --bearing 1 --allow-depth 1", "excludes");
  expect_refused(2, "rom joint.toml --out out --past 200", "past the limit");
  expect_refused(2, "rom joint.toml --out out --past -1", "past the limit");
  expect_refused(2, "rom joint.toml --out out --past nan", "past the limit");
  expect_refused(2, "rom joint.toml --out out --allow-depth -1", "depth");
  expect_refused(2, "rom joint.toml --out out --allow-depth 1 --exclude-reference-contacts", "excludes");
}

TEST_F(RomCommand, TakesMotionsInAnyCaseAndAsLists) {
  const Ran ran = done("rom joint.toml --motion FADIR,Flexion --motion faber --json");
  std::vector<std::string> names;
  const Json answer = Json::parse(ran.out);
  for (const Json& motion : answer["motions"]) names.push_back(motion["name"]);
  EXPECT_EQ(names, (std::vector<std::string>{"fadir", "flexion", "faber"}));
}

TEST_F(RomCommand, ListsItsMotions) {
  const Ran ran = done("rom joint.toml --list-motions");
  EXPECT_TRUE(
      says(ran.out,
           "fadir                            internal_rotation from 0 to 120, flexion 90, adduction 15\n"));
  EXPECT_EQ(std::count(ran.out.begin(), ran.out.end(), '\n'), 12);
}

TEST_F(RomCommand, BandsStandBesideLimitsAndInEveryFile) {
  expect_refused(2, "rom joint.toml --out out --band=3", "20 samples or more");
  expect_refused(2, "rom joint.toml --out out --seed 4", "requires --band");
  const Ran ran =
      done("rom joint.toml --motion flexion --band=40 --sigma-axes 0 --sigma-surface 0 --out out");
  EXPECT_TRUE(says(ran.out, "\xC2\xB0 ("));
  EXPECT_TRUE(says(ran.out, "band: 5 to 95 % of 40 joints"));
  const Json json = Json::parse(std::ifstream(here / "out" / "rom.json"));
  EXPECT_EQ(json["band"]["samples"], 40);
  const Json& band = json["motions"][0]["band"];
  EXPECT_LT(band["p5_deg"], band["median_deg"]);
  EXPECT_LT(band["median_deg"], band["p95_deg"]);
  EXPECT_EQ(band["width_from"]["axes_deg"], 0.0);
  EXPECT_EQ(run("rom joint.toml --motion flexion --band=40 --threads 1 --json").out,
            run("rom joint.toml --motion flexion --band=40 --threads 2 --json").out);
  EXPECT_TRUE(says(run("rom joint.toml").out, "band unknown"));
}

/// The printed table fits a terminal: it has the figures that people quote; all else is in rom.json and limits.csv.
TEST_F(RomCommand, PrintedLinesFitATerminal) {
  for (const char* options : {"", " --frame source", " --map flexion=0:10:10 adduction=0:10:10",
                              " --band=20 --past 5", " --allow-depth 1"}) {
    const auto lines = lines_of(run(std::string("rom joint.toml") + options).out);
    for (const std::string& line : lines) {
      const auto letters =
          std::count_if(line.begin(), line.end(), [](unsigned char c) { return (c & 0xC0) != 0x80; });
      EXPECT_LE(letters, 100) << line;
    }
    EXPECT_GT(lines.size(), 12u) << options;
  }
}

TEST_F(RomCommand, AnUnwritableFolderIsRefusedBeforeALongMap) {
  write("file", "in the way");
  const Ran ran = run(std::string("rom joint.toml --out file") + long_map);
  EXPECT_EQ(ran.exit_code, 3);
  EXPECT_TRUE(is_one_error_line(ran.err)) << ran.err;
}

TEST_F(RomCommand, BodiesInContactInTheReferencePoseAreExitCodeSixWithoutAnOption) {
  io::write_mesh(here / "fat.ply", box({-1, -100, -2}, {41, -10, 2}));
  write("joint.toml", text_of_joint({.mobile = "fat.ply"}));
  expect_refused(6, "rom joint.toml --out out", "in contact in the reference pose");
  expect_refused(6, "rom joint.toml --motion flexion --json", "--accept-reference-contact");
  const Json answer = this->answer("rom joint.toml --accept-reference-contact");
  EXPECT_EQ(answer["motions"][0]["reason"], "contact_at_start");
  EXPECT_EQ(answer["motions"][0]["limit_deg"], 0.0);
  EXPECT_FALSE(answer["caveats"].empty());
}

/// The last of the lines, without the progress before it.
std::string last_line(const std::string& text) {
  return text.substr(text.rfind('\n', text.size() - 2) + 1);
}

TEST_F(RomCommand, AnInterruptedMapLeavesNothingAndSaysSoInOneLine) {
  write_fine_meshes();
  for (const char* out : {"", " --out out/deeper"}) {
    const Ran ran =
        run_interrupted(here, std::string("rom joint.toml --motion flexion") + out + long_map, "map points");
    EXPECT_EQ(ran.exit_code, 130) << ran.err;
    EXPECT_EQ(ran.out, "");
    EXPECT_TRUE(is_one_error_line(last_line(ran.err))) << ran.err;
    EXPECT_TRUE(says(ran.err, "map points; nothing is written"));
    EXPECT_FALSE(fs::exists(here / "out"));
  }
}

}  // namespace
}  // namespace condyle::test
