#include "motion_scene.hpp"

/// Models whose joint frames are turned, and models that hold something harmless, on the command line.

namespace condyle::test {
namespace {

/// A thigh with a stop behind and one in front of a shank 20 mm thick, metres; the joint is at (0, -0.4, 0) of the thigh.
class ModelKnee : public CommandTest {
 protected:
  void SetUp() override {
    io::write_mesh(folder / "thigh.ply", joined(joined(box({-.03, -.35, -.02}, {.03, 0, .02}),
                                                       box({-.2, -.55, -.02}, {-.1, -.5, .02})),
                                                box({.03, -.55, -.02}, {.1, -.5, .02})));
    io::write_mesh(folder / "shank.ply", box({-.01, -.3, -.02}, {.01, -.02, .02}));
    write("knee.mot", "inDegrees=yes\nendheader\ntime q\n0 0\n1 10\n2 20\n3 30\n");
  }

  /// The frame is turned about Y in both bodies; the joint is a Pin, or turns about X of it and slides.
  void write_model(double about_y, bool is_pin, std::string_view side = "r",
                   std::string_view mesh = "thigh.ply") const {
    const auto frame = [&](const char* name, const char* body, const char* at) {
      return fmt::format(
          "<PhysicalOffsetFrame name=\"{}\"><socket_parent>/bodyset/{}_{}</socket_parent><translation>{}"
          "</translation><orientation>0 {:.17g} 0</orientation></PhysicalOffsetFrame>",
          name, body, side, at, about_y);
    };
    const std::string type = is_pin ? "PinJoint" : "CustomJoint";
    write("knee.osim", fmt::format(R"(<OpenSimDocument Version="40000"><Model name="knee"><BodySet><objects>
<Body name="femur_{0}"><attached_geometry><Mesh name="m"><mesh_file>{1}</mesh_file></Mesh></attached_geometry></Body>
<Body name="tibia_{0}"><attached_geometry><Mesh name="m"><mesh_file>shank.ply</mesh_file></Mesh></attached_geometry></Body>
</objects></BodySet><JointSet><objects><{2} name="knee_{0}"><socket_parent_frame>p</socket_parent_frame>
<socket_child_frame>c</socket_child_frame><coordinates><Coordinate name="q"/></coordinates><frames>{3}{4}</frames>{5}</{2}>
</objects></JointSet></Model></OpenSimDocument>)",
                                   side, mesh, type, frame("p", "femur", "0 -0.4 0"),
                                   frame("c", "tibia", "0 0 0"), is_pin ? "" : R"(<SpatialTransform>
<TransformAxis name="rotation1"><coordinates>q</coordinates><axis>1 0 0</axis></TransformAxis>
<TransformAxis name="translation1"><coordinates>q</coordinates><axis>1 0 0</axis>
<LinearFunction><coefficients>0.002 0</coefficients></LinearFunction></TransformAxis></SpatialTransform>)"));
  }
};

TEST_F(ModelKnee, HasTheLimitsOfItsShape) {
  // The shank meets an edge at (x, -150) after atan(x / 150) - asin(10 / hypot(x, 150)).
  const auto limit = [](double x) {
    return (std::atan(x / 150) - std::asin(10 / std::hypot(x, 150.0))) * 180 / std::numbers::pi;
  };
  for (const char* side : {"r", "l"})
    for (const double about_y : {0.0, std::numbers::pi}) {
      write_model(about_y, true, side);
      const std::string file = fmt::format("{}{:.0f}.toml", side, about_y);
      done(fmt::format("init knee.osim --joint knee_{} -o {}", side, file));
      const Json motions = answer("rom " + file + " --bearing count")["motions"];
      ASSERT_EQ(motions.size(), 2u);
      EXPECT_EQ(motions[0]["name"], "flexion");
      EXPECT_NEAR(motions[0]["limit_deg"], limit(100), 1e-9) << file;
      EXPECT_NEAR(motions[1]["limit_deg"], limit(30), 1e-9) << file;
    }
}

TEST_F(ModelKnee, FlexesAboutXOfATurnedFrame) {
  for (const char* side : {"r", "l"})
    for (const double sense : {1.0, -1.0}) {
      write_model(sense * std::numbers::pi / 2, false, side);
      const std::string out = fmt::format("o{}{}", side, sense > 0 ? 1 : 2);
      const Ran ran =
          done(fmt::format("motion knee.osim --joint knee_{} --motion knee.mot --out {}", side, out));
      EXPECT_TRUE(says(ran.err, sense > 0 ? "q grows with flexion" : "q grows with extension"));
      const NumberTable curves = csv_of(folder / (out + "/curves.csv"));
      ASSERT_EQ(curves.rows.size(), 4u);
      for (std::size_t row = 0; row < 4; ++row) {
        EXPECT_NEAR(curves.rows[row][curves.column("flexion_deg")], sense * 10.0 * static_cast<double>(row),
                    1e-9);
        EXPECT_NEAR(curves.rows[row][curves.column("adduction_deg")], 0, 1e-9);
        EXPECT_NEAR(curves.rows[row][curves.column("internal_rotation_deg")], 0, 1e-9);
      }
    }
}

TEST_F(ModelKnee, IsNotProposedSilentlyWithAMeshThatCannotBeRead) {
  write("bad.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n");
  write_model(0, true, "r", "bad.obj");
  const Ran ran = run("init knee.osim --joint knee_r -o k.toml");
  EXPECT_EQ(ran.exit_code, 3);
  EXPECT_TRUE(says(ran.err, "condyle: bad.obj: line 4"));
  EXPECT_FALSE(fs::exists(folder / "k.toml")) << "it would be in the way of the next proposal";
  EXPECT_TRUE(says(run("init knee.osim --joint knee_r").out, "bad.obj"));
}

}  // namespace
}  // namespace condyle::test
