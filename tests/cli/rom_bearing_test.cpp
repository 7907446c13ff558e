#include <sstream>

#include "command.hpp"

namespace condyle::test {
namespace {

/// Answers of `condyle rom` for a hip with a head: its bearing surface, bands and maps.
class RomOfSampleHip : public CommandTest {
 protected:
  void SetUp() override { sample_into(here, "hip"); }
  Json limits(const std::string& arguments) const { return answer("rom hip.toml " + arguments); }
};

TEST_F(RomOfSampleHip, TakesTheMarginGivenOrCountsEveryContact) {
  const Json usual = limits("--motion flexion")["bearing"];
  EXPECT_EQ(usual["rule"], "leave_out");
  const Json given = limits("--motion flexion --bearing 1.5")["bearing"];
  EXPECT_EQ(given["rule"], "leave_out");
  EXPECT_EQ(given["margin_mm"], 1.5);
  EXPECT_NE(given["margin_mm"], usual["margin_mm"]);
  EXPECT_LE(given["triangles"], usual["triangles"]);
  const Json counted = limits("--motion flexion --bearing count");
  EXPECT_EQ(counted["bearing"]["rule"], "count");
  EXPECT_TRUE(counted["motions"][0]["joint_space_mm"].is_null());
  EXPECT_TRUE(says(run("rom hip.toml --motion flexion --bearing count").out, "contact on it counts"));
  EXPECT_TRUE(says(run("rom hip.toml --motion flexion --bearing 1.5 --verbose").out,
                   "within 1.50 mm of the head's sphere"));
}

TEST_F(RomOfSampleHip, WritesTheMobileBodyWithItsBearingSurfaceMarked) {
  const Json bearing = limits("--motion flexion --out out --ascii")["bearing"];
  EXPECT_EQ(io::read_mesh(folder / "out/bearing.vtp").mesh, io::read_mesh(folder / "femur.ply").mesh);
  const std::string vtp = text_of("out/bearing.vtp");
  const auto at = vtp.find("Name=\"bearing\"");
  ASSERT_NE(at, vtp.npos);
  const auto begin = vtp.find('>', at) + 1;
  std::istringstream marks(vtp.substr(begin, vtp.find('<', begin) - begin));
  std::size_t triangles = 0, marked = 0;
  for (int mark; marks >> mark; ++triangles) marked += mark == 1;
  EXPECT_EQ(triangles, io::read_mesh(folder / "femur.ply").mesh.triangles.size());
  EXPECT_EQ(marked, bearing["triangles"]);
  EXPECT_GT(marked, 0u);
  EXPECT_LT(marked, triangles);
}

TEST_F(RomOfSampleHip, OfAHingeSaysThatEveryContactCounts) {
  edit("hip.toml", "kind = \"ball\"", "kind = \"hinge\"");
  const Ran ran = done("rom hip.toml");
  EXPECT_TRUE(
      says(ran.out,
           "  every contact counts: bearing contact is not distinguished from impingement in this joint\n"));
  EXPECT_EQ(limits("")["bearing"],
            (Json{{"rule", "count"},
                  {"why_none", "bearing contact is not distinguished from impingement in this joint"}}));
}

TEST_F(RomOfSampleHip, TakesUncertaintyFromTheJointFileUnlessOptionsSay) {
  const auto band_of = [&](const std::string& options) {
    return limits("--motion flexion --band=20 " + options)["band"];
  };
  EXPECT_EQ(band_of(""), (Json{{"samples", 20},
                               {"seed", 1},
                               {"sigma", {{"centre_mm", 0.5}, {"axes_deg", 1.0}, {"surface_mm", 0.25}}}}));
  edit("hip.toml", "[frame]", "[uncertainty]\ncentre = 0.75\naxes = 2\nsurface = 0.125\nseed = 42\n[frame]");
  const Json of_file = {{"samples", 20},
                        {"seed", 42},
                        {"sigma", {{"centre_mm", 0.75}, {"axes_deg", 2.0}, {"surface_mm", 0.125}}}};
  EXPECT_EQ(band_of(""), of_file);
  EXPECT_EQ(band_of("--seed 7 --sigma-axes 0.5"),
            (Json{{"samples", 20},
                  {"seed", 7},
                  {"sigma", {{"centre_mm", 0.75}, {"axes_deg", 0.5}, {"surface_mm", 0.125}}}}));
  const Json from_file = limits("--motion flexion --band=20")["motions"][0]["band"];
  EXPECT_NE(from_file, limits("--motion flexion --band=20 --seed 7")["motions"][0]["band"]);
  EXPECT_EQ(from_file, limits("--motion flexion --band=20 --seed 42")["motions"][0]["band"]);
}

}  // namespace
}  // namespace condyle::test
