#include "condyle/io/joint_file.hpp"
#include "condyle/io/mesh_file.hpp"
#include "condyle/io/provenance.hpp"
#include "core/predicates.hpp"
#include "support/joint_text.hpp"
#include "support/test.hpp"

/// Bodies whose meshes are given in frames of their own, and meshes found by the environment.

namespace condyle {
namespace {

TriMesh femur() {
  return test::box({-30, 20, -40}, {30, 300, 40});
}
TriMesh tibia() {
  return test::box({-25, -300, -35}, {25, -20, 35});
}

class JointBodyPose : public ::testing::Test {
 protected:
  void SetUp() override {
    io::write_mesh(folder / "femur.ply", femur());
    io::write_mesh(folder / "tibia.ply", tibia());
  }
  std::filesystem::path write(std::string_view fixed, std::string_view mobile, std::string_view more = "",
                              std::string_view units = "mm") const {
    return folder.file("joint.toml", test::joint_text({.kind = "free",
                                                       .units = units,
                                                       .keys = "joint = \"knee\"\n",
                                                       .fixed = fixed,
                                                       .mobile = mobile,
                                                       .centre = "[1, 2, 3]",
                                                       .axes = "anterior = [0, 1, 0]\nsuperior = [0, 0, 1]\n",
                                                       .more = more}));
  }
  std::string refusal(std::string_view fixed) const { return test::joint_refusal(write(fixed, plain_tibia)); }

  const test::TemporaryFolder folder;
  static constexpr const char* plain_femur = "mesh = \"femur.ply\"";
  static constexpr const char* plain_tibia = "mesh = \"tibia.ply\"";
};

/// A quarter turn about z and whole millimetres: nothing rounds.
constexpr const char* quarter_turn = "pose = [0, -1, 0, 5,  1, 0, 0, -6,  0, 0, 1, 7,  0, 0, 0, 1]\n";
Pose quarter_turned() {
  Pose X = Pose::Identity();
  X.linear() << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  X.translation() = Vec3(5, -6, 7);
  return X;
}

TEST_F(JointBodyPose, IsWhereTheMeshLiesAmongTheOthers) {
  const Joint own = io::read_joint(write(quarter_turn + std::string(plain_femur), plain_tibia)).joint;
  io::write_mesh(folder / "femur.ply", posed(quarter_turned(), femur()));
  const Joint common = io::read_joint(write(plain_femur, plain_tibia)).joint;
  EXPECT_EQ(own.fixed.mesh.arrays(), common.fixed.mesh.arrays());
  EXPECT_EQ(own.mobile.mesh.arrays(), common.mobile.mesh.arrays());
}

TEST_F(JointBodyPose, OfTheMobileBodyIsThatOfTheReferencePose) {
  const std::string reference = "[reference_pose]\nflexion = 30\nx = 4\n";
  const Joint own =
      io::read_joint(write(plain_femur, quarter_turn + std::string(plain_tibia), reference)).joint;
  io::write_mesh(folder / "tibia.ply", posed(quarter_turned(), tibia()));
  const Joint common = io::read_joint(write(plain_femur, plain_tibia, reference)).joint;
  EXPECT_LE(test::farthest(own.mobile.mesh.vertices(), common.mobile.mesh.vertices()),
            2 * core::rounding_unit * 512);
}

TEST_F(JointBodyPose, ATableOfTranslationAndAnglesIsThatMatrix) {
  // A knee's flexion by 90 degrees is R_z(-90).
  const JointDescription by_table =
      io::read_joint_file(
          write("pose = { translation = [5, -6, 7], flexion = -90 }\n" + std::string(plain_femur),
                plain_tibia))
          .joint;
  EXPECT_TRUE(by_table.fixed_in_W.matrix() == quarter_turned().matrix());
  EXPECT_TRUE(by_table.mobile_in_W.matrix() == Pose::Identity().matrix());
}

TEST_F(JointBodyPose, LengthsAreInTheUnitsOfTheFile) {
  const auto file = io::read_joint_file(write(
      "pose = [1, 0, 0, 0.005, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]\nmesh = \"a.ply\"", plain_tibia, "", "m"));
  EXPECT_EQ(file.joint.fixed_in_W.translation(), Vec3(5, 0, 0));
}

TEST_F(JointBodyPose, ABadOneIsRefusedByLineAndKey) {
  const std::string mesh = plain_femur + std::string("\n");
  for (const test::Refusal& pose : std::vector<test::Refusal>{
           {"[1, 2]", ": must be a list of sixteen numbers, not of 2"},
           {"[1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 5, -6, 7, 1]",
            ": the last row of the matrix must be 0 0 0 1, not 5 -6 7 1: it looks transposed"},
           {"[1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 2]",
            ": the last row of the matrix must be 0 0 0 1, not 0 0 0 2"},
           {"[1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, \"7\", 0, 0, 0, 1]", ": must be a number, not a text"},
           {"[1, 0, 0, nan, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]", ": must be a finite number"},
           {"[[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]",
            ": must be a list of sixteen numbers, not of 4"},
           {"{ translation = [5, -6] }", ".translation: must be a list of three numbers, not of 2"},
           {"{ flexion = \"30\" }", ".flexion: must be a number, not a text"},
           {"\"scan\"", ": must be a table, not a text"}})
    EXPECT_EQ(refusal(mesh + "pose = " + pose.given), "line 9: fixed.pose" + pose.says);
  test::expect_says(refusal(mesh + "pose = { dorsiflexion = 3 }"), "unknown key");
  test::expect_says(refusal(mesh + "poze = 1"), "unknown key (did you mean \"pose\"?)");
}

TEST_F(JointBodyPose, AnswersInTheSourceFrameLieOnTheFiles) {
  const io::LoadedJoint loaded = io::read_joint(write(quarter_turn + std::string(plain_femur), plain_tibia));
  const io::Provenance from = io::provenance_of(loaded, {}, io::AnswerFrameName::source);
  const TriMesh fixed = from.frame.fixed_mesh(loaded.joint.fixed.mesh);
  EXPECT_EQ(fixed.vertices, femur().vertices);
  EXPECT_EQ(test::mapped(femur(), [&](const Vec3& p) { return Vec3(from.fixed.joint_from_source * p); }),
            loaded.joint.fixed.mesh);
}

TEST_F(JointBodyPose, AMatrixOfFewDigitsIsMadeARotationWithANote) {
  const io::LoadedJoint loaded =
      io::read_joint(write("pose = [0.8660254, -0.5, 0, 0, 0.5, 0.8660254, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]\n" +
                               std::string(plain_femur),
                           plain_tibia));
  ASSERT_EQ(loaded.report.processing.size(), 1u);
  test::expect_says(loaded.report.processing[0], "fixed.pose: its rotation was off by");
  // Seven digits of sine and cosine: their length is off by 4e-9 and is made 1, which turns nothing.
  EXPECT_NEAR(loaded.report.file.joint.fixed_in_W(0, 0), std::sqrt(3) / 2, 1e-8);
}

TEST_F(JointBodyPose, AMeshMayBeNamedByTheEnvironment) {
  ASSERT_EQ(::setenv("CONDYLE_TEST_FOLDER", folder.path().string().c_str(), 1), 0);
  const io::JointFile file =
      io::read_joint_file(write("mesh = \"${CONDYLE_TEST_FOLDER}/femur.ply\"", plain_tibia));
  EXPECT_EQ(file.fixed.meshes[0].mesh, folder / "femur.ply");
  ASSERT_EQ(::unsetenv("CONDYLE_TEST_FOLDER"), 0);
  EXPECT_EQ(refusal("mesh = \"${CONDYLE_TEST_FOLDER}/femur.ply\""),
            "line 8: fixed.mesh: the environment variable 'CONDYLE_TEST_FOLDER' is not set");
  EXPECT_EQ(refusal("mesh = \"${CONDYLE_TEST_FOLDER/femur.ply\""), "line 8: fixed.mesh: has ${ without }");
}

}  // namespace
}  // namespace condyle
