#include "command.hpp"
#include "support/parametric_shoulder.hpp"

/// A shoulder, and joints whose surfaces slide by nature, on the command line.

namespace condyle::test {
namespace {

class Shoulder : public CommandTest {
 protected:
  void write_shoulder(const ParametricShoulder& shape, const std::string& joint = "shoulder") const {
    const Joint made = shoulder(shape);
    io::write_mesh(here / "scapula.ply", made.fixed.mesh);
    io::write_mesh(here / "humerus.ply", made.mobile.mesh);
    write("joint.toml", text_of_joint({.fixed = "name = \"scapula\"\nmesh = \"scapula.ply\"",
                                       .mobile = "name = \"humerus\"\nmesh = \"humerus.ply\"",
                                       .name = "joint",
                                       .joint = joint}));
  }
};

TEST_F(Shoulder, IsStoppedByItsAcromion) {
  const ParametricShoulder shape;
  write_shoulder(shape);
  const Json json = answer("rom joint.toml --motion abduction");
  const Json& abduction = json["motions"][0];
  EXPECT_NEAR(abduction["limit_deg"], shaft_limit(shape) * 180 / std::numbers::pi, 1e-9);
  EXPECT_EQ(abduction["contact_kind"], "impingement");
  EXPECT_EQ(abduction["contact_side"], "superior");
  EXPECT_TRUE(json["normal_range_source"].is_null());
  EXPECT_EQ(json["bearing"]["rule"], "leave_out");
  EXPECT_NEAR(json["bearing"]["beside_gap_mm"], 10, 1e-9);
  EXPECT_FALSE(has_note(json, "sliding_surfaces"));
  const Ran text = run("rom joint.toml --verbose");
  EXPECT_TRUE(says(text.out, "impingement, superior"));
  done("rom joint.toml --motion abduction --out out");
  EXPECT_TRUE(says(text_of("out/limits.csv"), ",superior,"));
  EXPECT_TRUE(says(text.out, "within 1.50 mm of the head's sphere"));
  EXPECT_FALSE(says(text.out, "beside its socket")) << "which limits nothing here";
}

TEST_F(Shoulder, SaysWhatLiesBesideItsSocketWhereThatLimitsTheMargin) {
  ParametricShoulder low;
  low.acromion_y = 25.2;
  write_shoulder(low);
  const Ran ran = done("rom joint.toml --motion abduction --verbose");
  EXPECT_TRUE(says(ran.out, "scapula 1.20 mm beside its socket"));
  EXPECT_TRUE(says(ran.err, "note: narrow_bearing_margin: scapula leaves the head only 1.20 mm"));
  EXPECT_NEAR(answer("rom joint.toml --motion abduction")["bearing"]["margin_mm"].get<double>(), 0.7, 1e-9);
}

TEST_F(Shoulder, HasNoClockFaceOrNeck) {
  write_shoulder({});
  expect_refused(4, "rom joint.toml --motion abduction --clock rim", "there is only the sagittal clock");
  const Json motion = answer("rom joint.toml --motion abduction --past 3")["motions"][0];
  EXPECT_TRUE(motion["clock_hour"].is_null() && motion["zone"]["fixed"]["clock_hour"].is_null());
  EXPECT_GT(motion["zone"]["mobile"]["triangles"], 0);
  EXPECT_TRUE(motion["zone"]["contact_neck_angle_deg"].is_null() &&
              motion["zone"]["mobile"]["neck_angle_deg"].is_null());
}

TEST_F(Shoulder, CalledAnElbowHasSurfacesThatSlideByNature) {
  write_shoulder({}, "elbow");
  const Json json = answer("rom joint.toml --motion varus");
  EXPECT_EQ(json["bearing"]["rule"], "count");
  EXPECT_TRUE(has_note(json, "sliding_surfaces"));
  EXPECT_TRUE(
      says(run("rom joint.toml --verbose").err, "note: sliding_surfaces: the surfaces of an elbow slide"));
}

}  // namespace
}  // namespace condyle::test
