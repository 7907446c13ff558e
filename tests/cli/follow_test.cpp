#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "command.hpp"
#include "condyle/io/mesh_file.hpp"
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
    write_mesh(folder / "arm.ply", box({-1, -100, -1}, {1, -50, 1}));
    write_mesh(folder / "post.ply", box({40, -80, -10}, {60, -60, 10}));
    write_mesh(folder / "ball.ply", sphere({0, 0, 0}, 20, 4));
    write_mesh(folder / "cup.ply", socket({0, 0, 0}, 20.5, 24, 4));
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

}  // namespace
}  // namespace condyle::test
