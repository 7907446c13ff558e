#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>

#include "command.hpp"
#include "condyle/io/mesh_file.hpp"
#include "io/file/whole_file.hpp"
#include "support/parametric_shoulder.hpp"
#include "support/temporary_folder.hpp"

/// A shoulder, and joints whose surfaces slide by nature, on the command line.

namespace condyle::test {
namespace {

using Json = nlohmann::json;

class Shoulder : public ::testing::Test {
 protected:
  void write(const ParametricShoulder& shape, const std::string& joint = "shoulder") const {
    const Joint made = shoulder(shape);
    io::write_mesh(folder / "scapula.ply", made.fixed.mesh);
    io::write_mesh(folder / "humerus.ply", made.mobile.mesh);
    std::ofstream(folder / "joint.toml")
        << "condyle = 1\nname = \"joint\"\nkind = \"ball\"\njoint = \"" << joint
        << "\"\nside = \"right\"\nunits = \"mm\"\n[fixed]\nname = \"scapula\"\n"
        << "mesh = \"scapula.ply\"\n[mobile]\nname = \"humerus\"\n"
        << "mesh = \"humerus.ply\"\n[frame]\ncentre = [0, 0, 0]\n"
        << "anterior = [1, 0, 0]\nsuperior = [0, 1, 0]\n";
  }
  Ran run(const std::string& arguments) const { return run_condyle(folder / ".", arguments); }
  Json answer(const std::string& arguments) const {
    const Ran ran = run(arguments + " --json");
    EXPECT_EQ(ran.exit_code, 0) << ran.err;
    return Json::parse(ran.out);
  }

  const TemporaryFolder folder;
};

bool has_code(const Json& answer, const std::string& code) {
  for (const Json& note : answer["notes"])
    if (note["code"] == code) return true;
  return false;
}

TEST_F(Shoulder, IsStoppedByItsAcromion) {
  const ParametricShoulder shape;
  write(shape);
  const Json json = answer("rom joint.toml --motion abduction");
  const Json& abduction = json["motions"][0];
  EXPECT_NEAR(abduction["limit_deg"].get<double>(), shaft_limit(shape) * 180 / std::numbers::pi, 1e-9);
  EXPECT_EQ(abduction["contact_kind"], "impingement");
  EXPECT_EQ(abduction["contact_side"], "superior");
  EXPECT_TRUE(json["normal_range_source"].is_null());
  EXPECT_EQ(json["bearing"]["rule"], "leave_out");
  EXPECT_NEAR(json["bearing"]["beside_gap_mm"].get<double>(), 10, 1e-9);
  EXPECT_FALSE(has_code(json, "sliding_surfaces"));
  const Ran text = run("rom joint.toml --verbose");
  EXPECT_NE(text.out.find("impingement, superior"), std::string::npos) << text.out;
  ASSERT_EQ(run("rom joint.toml --motion abduction --out out").exit_code, 0);
  EXPECT_NE(io::read_whole_file(folder / "out/limits.csv").find(",superior,"), std::string::npos);
  EXPECT_NE(text.out.find("within 1.50 mm of the head's sphere"), std::string::npos) << text.out;
  EXPECT_EQ(text.out.find("beside its socket"), std::string::npos) << "which limits nothing here";
}

TEST_F(Shoulder, SaysWhatLiesBesideItsSocketWhereThatLimitsTheMargin) {
  ParametricShoulder low;
  low.acromion_y = 25.2;
  write(low);
  const Ran ran = run("rom joint.toml --motion abduction --verbose");
  EXPECT_EQ(ran.exit_code, 0) << ran.err;
  EXPECT_NE(ran.out.find("scapula 1.20 mm beside its socket"), std::string::npos) << ran.out;
  EXPECT_NE(ran.err.find("note: narrow_bearing_margin: scapula leaves the head only 1.20 mm"),
            std::string::npos)
      << ran.err;
  EXPECT_NEAR(answer("rom joint.toml --motion abduction")["bearing"]["margin_mm"].get<double>(), 0.7, 1e-9);
}

TEST_F(Shoulder, HasNoClockFaceOrNeck) {
  write({});
  expect_refusal(run("rom joint.toml --motion abduction --clock rim"), 4, "there is only the sagittal clock",
                 "");
  const Json motion = answer("rom joint.toml --motion abduction --past 3")["motions"][0];
  EXPECT_TRUE(motion["clock_hour"].is_null() && motion["zone"]["fixed"]["clock_hour"].is_null());
  EXPECT_GT(motion["zone"]["mobile"]["triangles"], 0);
  EXPECT_TRUE(motion["zone"]["contact_neck_angle_deg"].is_null() &&
              motion["zone"]["mobile"]["neck_angle_deg"].is_null());
}

TEST_F(Shoulder, CalledAnElbowHasSurfacesThatSlideByNature) {
  write({}, "elbow");
  const Json json = answer("rom joint.toml --motion varus");
  EXPECT_EQ(json["bearing"]["rule"], "count");
  EXPECT_TRUE(has_code(json, "sliding_surfaces"));
  EXPECT_NE(
      run("rom joint.toml --verbose").err.find("note: sliding_surfaces: the surfaces of an elbow slide"),
      std::string::npos);
}

}  // namespace
}  // namespace condyle::test
