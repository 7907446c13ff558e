#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>

#include "command.hpp"
#include "condyle/io/mesh_file.hpp"
#include "io/file/whole_file.hpp"
#include "support/temporary_folder.hpp"
#include "support/test_meshes.hpp"

/// `condyle rom` and `study` for bodies of several meshes, each with a word for what contact on it means.

namespace condyle::test {
namespace {

using Json = nlohmann::json;

/// A bone with cartilage on a hinge, which swings forwards by a labrum, over a pad of cartilage and into a post.
class Layers : public ::testing::Test {
 protected:
  void SetUp() override {
    write("arm", box({-1, -100, -1}, {1, -50, 1}));
    write("sleeve", box({-1.2, -45, -1.2}, {1.2, -25, 1.2}));
    write("post", box({40, -80, -10}, {60, -60, 10}));
    write("pad", box({9, -40, -1}, {11, -30, 1}));
    write("labrum", box({5, -60, -1}, {6, -55, 1}));
    write_joint("bearing", "soft");
  }
  void write(const std::string& name, const TriMesh& mesh) const {
    io::write_mesh(folder / (name + ".ply"), mesh);
  }
  void write_joint(const std::string& pad, const std::string& labrum, const std::string& sleeve = "bearing",
                   const std::string& arm = "ends") const {
    std::ofstream(folder / "joint.toml")
        << "condyle = 1\nname = \"layers\"\nkind = \"hinge\"\nside = \"right\"\nunits = \"mm\"\n"
           "fixed = { name = \"frame\", meshes = [{ name = \"post\", mesh = \"post.ply\" },\n"
           "  { name = \"pad\", mesh = \"pad.ply\", contact = \""
        << pad << "\" },\n  { name = \"labrum\", mesh = \"labrum.ply\", contact = \"" << labrum
        << "\" }] }\nmobile = { name = \"limb\", meshes = [{ name = \"arm\", mesh = \"arm.ply\", contact = \""
        << arm << "\" },\n  { name = \"sleeve\", mesh = \"sleeve.ply\", contact = \"" << sleeve
        << "\" }] }\nframe = { centre = [0, 0, 0], anterior = [1, 0, 0], superior = [0, 1, 0] }\n";
  }
  Ran run(const std::string& arguments) const { return run_condyle(folder.path(), arguments); }
  Json flexion() const {
    const Ran ran = run("rom joint.toml --motion flexion --json");
    EXPECT_EQ(ran.exit_code, 0) << ran.err;
    return Json::parse(ran.out)["motions"][0];
  }

  const TemporaryFolder folder;
};

/// Where a corner at (x, y) stops something whose front is `half_width` before its middle line.
double stop_deg(double x, double y, double half_width) {
  return (std::atan2(x, -y) - std::asin(half_width / std::hypot(x, y))) * 180 / std::numbers::pi;
}

TEST_F(Layers, AreNamedWhereTheyEndAMotionAndWhereTheyDoNot) {
  const Json limit = flexion();
  EXPECT_NEAR(limit["limit_deg"].get<double>(), stop_deg(40, -80, 1), 1e-9);
  EXPECT_EQ(limit["contact_kind"], "impingement");
  EXPECT_EQ(limit["features"]["fixed"]["part"], "post");
  EXPECT_EQ(limit["features"]["mobile"]["part"], "arm");
  EXPECT_NEAR(limit["bearing_contact_deg"].get<double>(), stop_deg(9, -40, 1.2), 1e-9);
  EXPECT_NEAR(limit["soft_contact_deg"].get<double>(), stop_deg(5, -60, 1), 1e-9);
  EXPECT_EQ(limit["soft_contact_parts"], (Json{{"fixed", "labrum"}, {"mobile", "arm"}}));
  const std::string text = run("rom joint.toml --motion flexion").out;
  for (const auto line :
       {"bearing: sleeve slides on pad; contact of the two does not end a motion",
        "soft: labrum; contact on it does not end a motion", "soft (deg)", "bearing (deg)",
        "arm on post: flexion", "  soft meshes touched on the way:\n    arm on labrum: flexion\n"})
    EXPECT_NE(text.find(line), text.npos) << line << "\n" << text;
  EXPECT_EQ(text.find("sliding_surfaces"), text.npos) << "meshes say what slides";
}

TEST_F(Layers, EndAMotionByTheirWord) {
  write_joint("ends", "soft");
  EXPECT_NEAR(flexion()["limit_deg"].get<double>(), stop_deg(40, -80, 1), 1e-9)
      << "no mesh of the frame is bearing: the sleeve slides on all of it";
  write_joint("bearing", "ends");
  EXPECT_NEAR(flexion()["limit_deg"].get<double>(), stop_deg(5, -60, 1), 1e-9);
  EXPECT_EQ(flexion()["features"]["fixed"]["part"], "labrum");
  write_joint("bearing", "soft", "ends");
  EXPECT_NEAR(flexion()["limit_deg"].get<double>(), stop_deg(9, -40, 1.2), 1e-9);
  write_joint("bearing", "soft");
  const Ran counted = run("rom joint.toml --motion flexion --bearing count --json");
  EXPECT_NEAR(Json::parse(counted.out)["motions"][0]["limit_deg"].get<double>(), stop_deg(9, -40, 1.2), 1e-9);
}

TEST_F(Layers, AreTheSameInFilesAndStudies) {
  ASSERT_EQ(run("rom joint.toml --motion flexion --out out").exit_code, 0);
  const std::string csv = io::read_whole_file(folder / "out/limits.csv");
  EXPECT_NE(csv.find(",post,arm,"), csv.npos) << csv;
  std::ofstream(folder / "table.csv") << "id,joint\na,joint.toml\n";
  const Ran study = run("study table.csv --motion flexion --out study");
  ASSERT_EQ(study.exit_code, 0) << study.err;
  const std::string limits = io::read_whole_file(folder / "study/limits.csv");
  EXPECT_NE(limits.find("soft_contact_deg"), limits.npos);
  EXPECT_NE(limits.find(",post,arm"), limits.npos) << limits;
  for (const std::string& table : {csv, limits}) EXPECT_NE(table.find(",labrum,arm,"), table.npos) << table;
}

TEST_F(Layers, AreRefusedWhereNothingEndsAMotion) {
  const auto refusal = [&](const char* what) {
    const Ran ran = run("rom joint.toml");
    EXPECT_EQ(ran.exit_code, 3) << what;
    EXPECT_NE(ran.err.find(what), ran.err.npos) << ran.err;
  };
  write_joint("bearing", "soft", "bearing", "bearing");
  refusal("mobile.meshes: none of them ends a motion: one needs contact = \"ends\"");
  write_joint("hard", "soft");
  refusal("fixed.meshes[1].contact: must be \"ends\" or \"bearing\" or \"soft\", not \"hard\"");
}

}  // namespace
}  // namespace condyle::test
