#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "command.hpp"
#include "condyle/io/mesh_file.hpp"
#include "io/file/whole_file.hpp"
#include "support/report_block.hpp"
#include "support/temporary_folder.hpp"
#include "support/test_meshes.hpp"

/// `condyle rom --follow` and `--follow-load`: the centre is not held.

namespace condyle::test {
namespace {

using Json = nlohmann::json;

/// An arm on a ball in a cup with a post, as a free joint, with cartilage on ball and cup.
class Follow : public ::testing::Test {
 protected:
  void SetUp() override {
    io::write_mesh(folder / "arm.ply", box({-1, -100, -1}, {1, -50, 1}));
    io::write_mesh(folder / "post.ply", box({40, -80, -10}, {60, -60, 10}));
    io::write_mesh(folder / "ball.ply", sphere({0, 0, 0}, 20, 4));
    io::write_mesh(folder / "cup.ply", socket({0, 0, 0}, 20.5, 24, 4));
    std::ofstream(folder / "joint.toml")
        << "condyle = 1\nname = \"swing\"\nkind = \"free\"\njoint = \"hip\"\nside = \"right\"\nunits = "
           "\"mm\"\n"
           "fixed = { name = \"frame\", meshes = [{ name = \"post\", mesh = \"post.ply\" },\n"
           "  { name = \"cup\", mesh = \"cup.ply\", contact = \"bearing\" }] }\n"
           "mobile = { name = \"limb\", meshes = [{ name = \"arm\", mesh = \"arm.ply\" },\n"
           "  { name = \"ball\", mesh = \"ball.ply\", contact = \"bearing\" }] }\n"
           "frame = { centre = [0, 0, 0], anterior = [1, 0, 0], superior = [0, 1, 0] }\n"
           "[contact]\nfixed_part = \"cup\"\nmobile_part = \"ball\"\n"
           "fixed = { youngs_modulus_mpa = 12, poisson_ratio = 0.42, thickness = 1.5 }\n"
           "mobile = { youngs_modulus_mpa = 12, poisson_ratio = 0.42, thickness = 1.5 }\n";
    std::ofstream record(folder / "record.csv");
    record << "time,flexion_deg,x_mm\n";
    for (int i = 0; i <= 60; ++i) record << i * 0.1 << "," << i << "," << -0.1 * i << "\n";
  }
  Ran run(const std::string& arguments) const { return run_condyle(folder.path(), arguments); }

  const TemporaryFolder folder;
};

TEST_F(Follow, ARecordedMotionMovesTheCentre) {
  const Ran ran = run("rom joint.toml --follow record.csv --json");
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  const Json json = Json::parse(ran.out);
  EXPECT_EQ(json["exact"], false);
  ASSERT_EQ(json["motions"].size(), 1u) << "the record leads along flexion only";
  const Json& limit = json["motions"][0];
  EXPECT_EQ(limit["name"], "flexion");
  EXPECT_EQ(limit["reason"], "contact");
  EXPECT_EQ(limit["features"]["fixed"]["part"], "post");
  EXPECT_NEAR(limit["translation_mm"][0].get<double>(), -0.1 * limit["limit_deg"].get<double>(), 1e-9);
  EXPECT_NE(limit["guarantee"].get<std::string>().find("bounded, not exact"), std::string::npos);
  const Json held = Json::parse(run("rom joint.toml --motion flexion --json").out);
  EXPECT_EQ(held["exact"], true);
  EXPECT_TRUE(held["motions"][0]["translation_mm"].is_null());
  EXPECT_GT(limit["limit_deg"].get<double>(), held["motions"][0]["limit_deg"].get<double>() + 0.5)
      << "the arm moves away from the post";
  EXPECT_NE(run("rom joint.toml --follow record.csv").out.find("limits are bounded"), std::string::npos);
}

TEST_F(Follow, ALoadMovesTheCentre) {
  const Ran ran = run("rom joint.toml --motion flexion --follow-load --force 300 900 0 --json");
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  const Json limit = Json::parse(ran.out)["motions"][0];
  EXPECT_EQ(limit["reason"], "contact");
  EXPECT_GT(limit["translation_mm"][0].get<double>(), 0.1);
  EXPECT_EQ(limit["bearing_contact_deg"], 0.0) << "the cartilage is pressed together from the start";
}

TEST_F(Follow, WhatItFollowsMayEndBeforeTheMotion) {
  std::ofstream(folder / "short.csv") << "time,flexion_deg,x_mm\n0,0,0\n1,12,-1\n";
  const auto motion = [&](const std::string& follow) {
    const Ran ran = run("rom joint.toml --motion flexion --json " + follow);
    EXPECT_EQ(ran.exit_code, 0) << ran.err;
    return Json::parse(ran.out)["motions"][0];
  };
  EXPECT_EQ(motion("--follow record.csv")["translation_ends"], false);
  EXPECT_TRUE(Json::parse(run("rom joint.toml --motion flexion --json").out)["motions"][0]["translation_ends"]
                  .is_null());
  const Json ends = motion("--follow short.csv");
  EXPECT_EQ(ends["translation_ends"], true);
  EXPECT_NEAR(ends["limit_deg"].get<double>(), 12, 1e-9);
  EXPECT_EQ(ends["guarantee"],
            "free over 12 deg, as far as what the translation follows goes; unknown past it");
  const Ran text = run("rom joint.toml --motion flexion --follow short.csv");
  EXPECT_NE(text.out.find("12.00  no contact, translation ends"), std::string::npos) << text.out;
  EXPECT_EQ(text.out.find("no contact in range"), std::string::npos) << text.out;

  const std::string out_of_the_cup = "--follow-load --force 0 -900 0";
  const Json none = motion(out_of_the_cup);
  EXPECT_EQ(none["translation_ends"], true);
  EXPECT_TRUE(none["translation_mm"].is_null());
  EXPECT_EQ(none["guarantee"], "none: no contact carries the load at the start");
  const Ran said = run("rom joint.toml --motion flexion " + out_of_the_cup);
  EXPECT_NE(said.out.find("-  unknown: load not carried"), std::string::npos) << said.out;
  EXPECT_NE(
      said.err.find("note: translation_ends: flexion: no contact carries the load 0 degrees past its start"),
      std::string::npos)
      << said.err;
}

TEST_F(Follow, IsRefusedInOneLine) {
  const auto refusal = [&](const std::string& arguments, int exit_code, const std::string& what) {
    const Ran ran = run("rom joint.toml " + arguments);
    EXPECT_EQ(ran.exit_code, exit_code) << arguments << ran.err;
    EXPECT_NE(ran.err.find(what), ran.err.npos) << ran.err;
  };
  refusal("--follow nothere.csv", 3, "nothere.csv");
  refusal("--motion extension --follow record.csv", 2, "record.csv: extension: the recorded angle");
  refusal("--follow-load", 2, "needs --force");
  refusal("--force 1 2 3", 2, "--follow-load");
  refusal("--follow record.csv --band", 2, "--band");
  std::ofstream(folder / "back.csv") << "time,flexion_deg\n0,0\n1,20\n2,10\n3,30\n";
  refusal("--follow back.csv", 2, "turns back");
}

TEST_F(Follow, WhatLooksWrongIsNoted) {
  const auto codes = [&](const std::string& arguments) {
    const Ran ran = run("rom joint.toml --motion flexion --json " + arguments);
    EXPECT_EQ(ran.exit_code, 0) << ran.err;
    std::string codes;
    const Json notes = Json::parse(ran.out)["notes"];
    for (const Json& note : notes) {
      const auto code = note["code"].get<std::string>();
      EXPECT_NE(ran.err.find("condyle: note: " + code), std::string::npos) << ran.err;
      codes += code + " ";
    }
    return codes;
  };
  const std::string usual = codes("--follow record.csv");
  std::ofstream far(folder / "far.csv");
  far << "time,flexion_deg,x_mm,z_mm\n0,0,0,0\n1,30,-3,0\n2,60,-6,2000\n";
  far.close();
  EXPECT_EQ(codes("--follow far.csv"), usual + "unlikely_translation ");
  EXPECT_EQ(run("rom joint.toml --motion flexion --strict --follow far.csv").exit_code, 4);
  const std::string loaded = codes("--follow-load --force 300 900 0");
  EXPECT_EQ(codes("--follow-load --force 3000 9000 0").find("unlikely_load"), loaded.size())
      << "after notes on limits and layers";
}

TEST_F(Follow, AReportHasTheSameLimitsAndSaysThatTheyAreBounded) {
  for (const std::string follow :
       {"--follow record.csv", "--follow-load --force 300 900 0 --along 1 0 0 0 1 0"}) {
    SCOPED_TRACE(follow);
    const Ran ran = run("report joint.toml --out page.html " + follow);
    ASSERT_EQ(ran.exit_code, 0) << ran.err;
    Json page = report_block(io::read_whole_file(folder / "page.html")).json;
    const Json rom = Json::parse(run("rom joint.toml --json " + follow).out);
    EXPECT_EQ(page["rom"]["exact"], false);
    EXPECT_EQ(page["rom"]["motions"], rom["motions"]);
    EXPECT_EQ(page["rom"]["caveats"], rom["caveats"]);
    EXPECT_EQ(page["rom"]["notes"], rom["notes"]);
    ASSERT_GE(page["poses"].size(), 2u);
    const Json& limit = rom["motions"][0];
    const Json& pose = page["poses"][1];
    EXPECT_EQ(pose["name"], limit["name"]);
    for (std::size_t axis = 0; axis < 3; ++axis)
      EXPECT_EQ(pose["pose"][4 * axis + 3], limit["translation_mm"][axis]) << "where it is at the limit";
  }
  for (const char* option :
       {"--band", "--translation \"x=1\"", "--past 5", "--map flexion=0:20:10 adduction=0:10:10"})
    EXPECT_EQ(run(std::string("report joint.toml --out p.html --follow record.csv ") + option).exit_code, 2)
        << option;
  EXPECT_NE(run("report joint.toml --out p.html --follow-load").err.find("needs --force"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(folder / "p.html"));
}

/// Rows of a table of results, its comments and names left out.
std::vector<std::vector<std::string>> rows_of(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::vector<std::vector<std::string>> rows;
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("#")) continue;
    std::vector<std::string> fields;
    line += ",";
    std::istringstream stream(line);
    for (std::string field; std::getline(stream, field, ',');) fields.push_back(field);
    rows.push_back(fields);
  }
  return rows;
}

std::string field(const std::vector<std::vector<std::string>>& rows, std::size_t row,
                  const std::string& name) {
  const auto at = std::find(rows.at(0).begin(), rows.at(0).end(), name);
  EXPECT_NE(at, rows[0].end()) << name;
  return at == rows[0].end() ? "" : rows.at(row).at(static_cast<std::size_t>(at - rows[0].begin()));
}

TEST_F(Follow, AStudyHasTheSameLimits) {
  std::ofstream(folder / "joints.csv") << "id,joint,follow\nled,joint.toml,record.csv\nheld,joint.toml,\n"
                                          "gone,joint.toml,none.csv\nback,joint.toml,back.csv\n";
  std::ofstream(folder / "back.csv") << "time,flexion_deg\n0,0\n1,20\n2,10\n3,30\n";
  const Ran ran = run("study joints.csv --out study");
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  const Json limit = Json::parse(run("rom joint.toml --follow record.csv --json").out)["motions"][0];
  const auto limits = rows_of(folder / "study/limits.csv"), hips = rows_of(folder / "study/hips.csv"),
             failures = rows_of(folder / "study/failures.csv");
  ASSERT_EQ(limits.size(), 2u);
  EXPECT_EQ(std::stod(field(limits, 1, "limit_deg")), limit["limit_deg"].get<double>());
  EXPECT_EQ(std::stod(field(limits, 1, "translation_x_mm")), limit["translation_mm"][0].get<double>());
  EXPECT_EQ(field(limits, 1, "translation_ends"), "false");
  EXPECT_EQ(field(hips, 1, "exact"), "0");
  ASSERT_EQ(failures.size(), 4u);
  EXPECT_NE(field(failures, 1, "message").find("is a free joint"), std::string::npos);
  EXPECT_NE(field(failures, 2, "message").find("none.csv: no such file"), std::string::npos);
  EXPECT_NE(field(failures, 3, "message").find("joints.csv: line 5: column 'follow'"), std::string::npos);
  // Once more: nothing changed. A changed record is another input.
  EXPECT_NE(run("study joints.csv --out study").err.find("is there already"), std::string::npos);
  std::ofstream(folder / "record.csv") << "time,flexion_deg,x_mm\n0,0,0\n1,60,-3\n";
  EXPECT_EQ(run("study joints.csv --out study").err.find("is there already"), std::string::npos);
}

TEST_F(Follow, AStudyFollowsALoad) {
  std::ofstream(folder / "joints.csv") << "id,joint\none,joint.toml\n";
  const std::string force = " --motion flexion --follow-load --force 300 900 0";
  const Ran ran = run("study joints.csv --out study" + force);
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  const Json limit = Json::parse(run("rom joint.toml --json" + force).out)["motions"][0];
  const auto limits = rows_of(folder / "study/limits.csv");
  EXPECT_EQ(std::stod(field(limits, 1, "limit_deg")), limit["limit_deg"].get<double>());
  EXPECT_EQ(field(rows_of(folder / "study/hips.csv"), 1, "exact"), "0");
  const Ran planned = run("study joints.csv --out planned --resect flexion=90" + force);
  EXPECT_EQ(planned.exit_code, 3);
  EXPECT_NE(planned.err.find("is a free joint, and a study plans none"), std::string::npos) << planned.err;
  for (const auto& [arguments, saying] : {std::pair{"--follow-load", "needs --force"},
                                          {"--force 1 2 3", "needs --load or --follow-load"},
                                          {"--follow-load --load \"\" --force 1 2 3", "stands beside --load"},
                                          {"--follow-load --force 300 900 0 --band", "limits only"}}) {
    const Ran refused = run(std::string("study joints.csv --out other ") + arguments);
    EXPECT_EQ(refused.exit_code, 2) << arguments << refused.err;
    EXPECT_NE(refused.err.find(saying), std::string::npos) << refused.err;
  }
}

}  // namespace
}  // namespace condyle::test
