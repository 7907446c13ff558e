#include "command.hpp"

/// `condyle rom` and `study` for bodies of several meshes, each with a word for what contact on it means.

namespace condyle::test {
namespace {

/// A bone with cartilage on a hinge, which swings forwards by a labrum, over a pad of cartilage and into a post.
class Layers : public CommandTest {
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
    const auto mesh = [](const std::string& name, const std::string& contact) {
      return fmt::format("{{ name = \"{0}\", mesh = \"{0}.ply\", contact = \"{1}\" }}", name, contact);
    };
    CommandTest::write(
        "joint.toml",
        text_of_joint({.fixed = "name = \"frame\"\nmeshes = [{ name = \"post\", mesh = \"post.ply\" },\n  " +
                                mesh("pad", pad) + ",\n  " + mesh("labrum", labrum) + "]",
                       .mobile = "name = \"limb\"\nmeshes = [" + mesh("arm", arm) + ",\n  " +
                                 mesh("sleeve", sleeve) + "]",
                       .kind = "hinge",
                       .name = "layers"}));
  }
  Json flexion() const { return answer("rom joint.toml --motion flexion")["motions"][0]; }
};

/// Where a corner at (x, y) stops something whose front is `half_width` before its middle line.
double stop_deg(double x, double y, double half_width) {
  return (std::atan2(x, -y) - std::asin(half_width / std::hypot(x, y))) * 180 / std::numbers::pi;
}

TEST_F(Layers, AreNamedWhereTheyEndAMotionAndWhereTheyDoNot) {
  const Json limit = flexion();
  EXPECT_NEAR(limit["limit_deg"], stop_deg(40, -80, 1), 1e-9);
  EXPECT_EQ(limit["contact_kind"], "impingement");
  EXPECT_EQ(limit["features"]["fixed"]["part"], "post");
  EXPECT_EQ(limit["features"]["mobile"]["part"], "arm");
  EXPECT_NEAR(limit["bearing_contact_deg"], stop_deg(9, -40, 1.2), 1e-9);
  EXPECT_NEAR(limit["soft_contact_deg"], stop_deg(5, -60, 1), 1e-9);
  EXPECT_EQ(limit["soft_contact_parts"], (Json{{"fixed", "labrum"}, {"mobile", "arm"}}));
  const std::string text = run("rom joint.toml --motion flexion").out;
  for (const auto line :
       {"bearing: sleeve slides on pad; contact of the two does not end a motion",
        "soft: labrum; contact on it does not end a motion", "soft (deg)", "bearing (deg)",
        "arm on post: flexion", "  soft meshes touched on the way:\n    arm on labrum: flexion\n"})
    EXPECT_TRUE(says(text, line)) << line;
  EXPECT_FALSE(says(text, "sliding_surfaces")) << "meshes say what slides";
}

TEST_F(Layers, EndAMotionByTheirWord) {
  write_joint("ends", "soft");
  EXPECT_NEAR(flexion()["limit_deg"], stop_deg(40, -80, 1), 1e-9)
      << "no mesh of the frame is bearing: the sleeve slides on all of it";
  write_joint("bearing", "ends");
  EXPECT_NEAR(flexion()["limit_deg"], stop_deg(5, -60, 1), 1e-9);
  EXPECT_EQ(flexion()["features"]["fixed"]["part"], "labrum");
  write_joint("bearing", "soft", "ends");
  EXPECT_NEAR(flexion()["limit_deg"], stop_deg(9, -40, 1.2), 1e-9);
  write_joint("bearing", "soft");
  const Ran counted = run("rom joint.toml --motion flexion --bearing count --json");
  EXPECT_NEAR(Json::parse(counted.out)["motions"][0]["limit_deg"], stop_deg(9, -40, 1.2), 1e-9);
}

TEST_F(Layers, AreTheSameInFilesAndStudies) {
  done("rom joint.toml --motion flexion --out out");
  const std::string csv = text_of("out/limits.csv");
  EXPECT_TRUE(says(csv, ",post,arm,"));
  CommandTest::write("table.csv", "id,joint\na,joint.toml\n");
  const Ran study = done("study table.csv --motion flexion --out study");
  const std::string limits = text_of("study/limits.csv");
  EXPECT_TRUE(says(limits, "soft_contact_deg"));
  EXPECT_TRUE(says(limits, ",post,arm"));
  for (const std::string& table : {csv, limits}) EXPECT_TRUE(says(table, ",labrum,arm,"));
}

TEST_F(Layers, AreRefusedWhereNothingEndsAMotion) {
  write_joint("bearing", "soft", "bearing", "bearing");
  expect_refused(3, "rom joint.toml",
                 "mobile.meshes: none of them ends a motion: one needs contact = \"ends\"");
  write_joint("hard", "soft");
  expect_refused(3, "rom joint.toml",
                 "fixed.meshes[1].contact: must be \"ends\" or \"bearing\" or \"soft\", not \"hard\"");
}

}  // namespace
}  // namespace condyle::test
