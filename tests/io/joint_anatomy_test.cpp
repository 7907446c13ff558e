#include "condyle/io/joint_file.hpp"
#include "condyle/io/mesh_file.hpp"
#include "core/predicates.hpp"
#include "io/result/frame_result.hpp"
#include "support/joint_text.hpp"
#include "support/test.hpp"

/// Joint files of joints other than the hip, and of joints that translate.

namespace condyle {
namespace {

constexpr const char* knee_landmarks =
    "[frame.landmarks]\nmedial_epicondyle = [0, 0, -40]\nlateral_epicondyle = [0, 0, 40]\n"
    "hip_centre = [0, 400, 0]\n";

class JointAnatomy : public ::testing::Test {
 protected:
  void SetUp() override {
    io::write_mesh(folder / "femur.ply", test::box({-30, 20, -40}, {30, 300, 40}));
    io::write_mesh(folder / "tibia.ply", test::box({-25, -300, -35}, {25, -20, 35}));
  }
  std::filesystem::path with_axes(std::string_view kind, std::string_view keys, std::string_view after = "",
                                  std::string_view axes = test::plain_axes) const {
    return folder.file("joint.toml", test::joint_text({.kind = kind,
                                                       .keys = keys,
                                                       .fixed = "mesh = \"femur.ply\"",
                                                       .mobile = "mesh = \"tibia.ply\"",
                                                       .centre = axes == knee_landmarks ? "" : "[0, 0, 0]",
                                                       .axes = axes,
                                                       .more = after}));
  }
  JointDescription description(std::string_view kind, std::string_view keys,
                               std::string_view axes = test::plain_axes) const {
    return io::read_joint_file(with_axes(kind, keys, "", axes)).joint;
  }
  std::string refusal(std::string_view kind, std::string_view keys, std::string_view after = "") const {
    return test::joint_refusal(with_axes(kind, keys, after));
  }

  const test::TemporaryFolder folder;
};

TEST_F(JointAnatomy, IsOneOfFive) {
  for (const Anatomy anatomy : all_anatomies) {
    const std::string key = "joint = \"" + std::string(name_of(anatomy)) + "\"\n";
    EXPECT_EQ(description("ball", key).anatomy, anatomy);
    EXPECT_EQ(description("free", key).anatomy, anatomy);
  }
  EXPECT_EQ(refusal("ball", "joint = \"wrist\"\n").substr(0, 20), "line 6: joint: must ");
}

TEST_F(JointAnatomy, ABallIsAHipUnlessItSaysOtherwise) {
  EXPECT_EQ(description("ball", "").anatomy, Anatomy::hip);
  EXPECT_TRUE(io::read_joint(with_axes("ball", "")).joint.is_hip());
  EXPECT_FALSE(io::read_joint(with_axes("ball", "joint = \"shoulder\"\n")).joint.is_hip());
}

TEST_F(JointAnatomy, AHingeOnTheLandmarksOfAKneeIsAKneeElseItFlexesForwards) {
  const Vec3 foot(0, -400, 0);
  const auto flexed = [&](const JointDescription& joint) {
    return posed(pose_at(joint.coordinates(), JointAngles{Angle::degrees(90), {}, {}}), foot);
  };
  EXPECT_EQ(flexed(description("hinge", "", knee_landmarks)), Vec3(-400, 0, 0));
  EXPECT_EQ(flexed(description("hinge", "joint = \"knee\"\n")), Vec3(-400, 0, 0));
  EXPECT_EQ(flexed(description("hinge", "")), Vec3(400, 0, 0));
  EXPECT_EQ(flexed(description("hinge", "joint = \"elbow\"\n", knee_landmarks)), Vec3(400, 0, 0));
}

TEST_F(JointAnatomy, AHingeIsNoHipOrShoulder) {
  EXPECT_EQ(refusal("hinge", "joint = \"shoulder\"\n"),
            "line 6: joint: a shoulder is no hinge; left out, a hinge flexes forwards");
  EXPECT_NE(refusal("hinge", "joint = \"hip\"\n"), "accepted");
}

TEST_F(JointAnatomy, AFreeJointMustSayWhichItIs) {
  EXPECT_EQ(refusal("free", ""),
            "line 1: joint: is missing: a free joint needs \"hip\", \"knee\", \"ankle\", \"elbow\" or "
            "\"shoulder\", which name its angles");
}

TEST_F(JointAnatomy, OnlyAFreeJointHasATranslationFrame) {
  EXPECT_EQ(description("free", "joint = \"knee\"\n").translation_frame, TranslationFrame::fixed);
  EXPECT_EQ(description("free", "joint = \"knee\"\ntranslation_frame = \"joint_axes\"\n").translation_frame,
            TranslationFrame::joint_axes);
  EXPECT_EQ(refusal("ball", "translation_frame = \"fixed\"\n"),
            "line 6: translation_frame: a ball does not translate");
  EXPECT_EQ(refusal("free", "joint = \"shoulder\"\ntranslation_frame = \"joint_axes\"\n"),
            "line 7: translation_frame: a shoulder has two of its axes along one line: use \"fixed\"");
}

TEST_F(JointAnatomy, TheReferencePoseHasTheNamesOfTheJoint) {
  const io::JointFile file = io::read_joint_file(
      with_axes("ball", "joint = \"ankle\"\n", "[reference_pose]\ndorsiflexion = 10\ninversion = -3\n"));
  EXPECT_EQ(file.reference_pose, (io::PoseDegrees{10, -3, 0, Vec3::Zero()}));
  test::expect_says(refusal("ball", "joint = \"ankle\"\n", "[reference_pose]\nflexion = 10\n"),
                    "unknown key");
}

TEST_F(JointAnatomy, OnlyAFreeJointTranslatesInItsReferencePose) {
  const io::JointFile file = io::read_joint_file(
      with_axes("free", "joint = \"knee\"\n", "[reference_pose]\nflexion = 20\nx = 1.5\nz = -2\n"));
  EXPECT_EQ(file.reference_pose, (io::PoseDegrees{20, 0, 0, {1.5, 0, -2}}));
  EXPECT_EQ(refusal("ball", "", "[reference_pose]\nx = 1\n").substr(0, 8), "line 15:");
  test::expect_says(refusal("ball", "", "[reference_pose]\nx = 1\n"), "a ball does not translate");
}

/// In whatever translation frame the reference pose is given, the posed mesh is the given one.
TEST_F(JointAnatomy, AMobileMeshIsWhereItWasGivenInItsReferencePose) {
  const TriMesh given = io::read_mesh(folder / "tibia.ply").mesh;
  for (const char* frame : {"fixed", "joint_axes"}) {
    const auto [joint, report] = io::read_joint(
        with_axes("free", "joint = \"knee\"\ntranslation_frame = \"" + std::string(frame) + "\"\n",
                  "[reference_pose]\nflexion = 30\nadduction = 4\ninternal_rotation = -8\nx = 5\ny = -7\nz = "
                  "2\n"));
    const Pose X_FM = pose_at(joint.coordinates(), report.placement.reference_pose, joint.translation_frame);
    for (std::size_t v = 0; v < given.vertices.size(); ++v)
      // Placing rounds once, posing back by 4u of three products of 300 mm.
      EXPECT_LE((posed(X_FM, joint.mobile.mesh.vertices()[v]) - given.vertices[v]).norm(),
                8 * core::rounding_unit * 3 * 300);
    test::expect_says(io::frame_json({joint, report}, {}),
                      "\"translation_frame\": \"" + std::string(frame) + "\"");
  }
}

TEST_F(JointAnatomy, LengthsOfAReferencePoseAreInTheUnitsOfTheFile) {
  const std::string text = test::joint_text(
      {.kind = "free", .units = "m", .keys = "joint = \"knee\"\n", .more = "[reference_pose]\ny = 0.25\n"});
  EXPECT_EQ(io::read_joint_file(folder.file("metres.toml", text)).reference_pose.translation_mm,
            Vec3(0, 250, 0));
}

TEST_F(JointAnatomy, AMotionVariesAndHoldsAnglesByTheNamesOfTheJoint) {
  const io::JointFile file = io::read_joint_file(
      with_axes("ball", "joint = \"shoulder\"\n",
                "[[motion]]\nname = \"scaption\"\nvary = \"elevation\"\nrange = [0, 150]\n"
                "plane_of_elevation = 30\n"));
  ASSERT_EQ(file.motions.size(), 1u);
  EXPECT_EQ(file.motions[0].vary, JointAngle::adduction);
  EXPECT_EQ(file.motions[0].start.flexion, Angle::degrees(30));
}

TEST_F(JointAnatomy, AHingesErrorsNameItsOwnAngle) {
  test::expect_says(refusal("hinge", "joint = \"ankle\"\n", "[reference_pose]\ninversion = 3\n"),
                    "reference_pose.inversion: a hinge rotates in dorsiflexion only");
}

}  // namespace
}  // namespace condyle
