#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "condyle/error.hpp"
#include "condyle/io/joint_file.hpp"
#include "condyle/io/mesh_file.hpp"
#include "condyle/io/provenance.hpp"
#include "core/predicates.hpp"
#include "support/temporary_folder.hpp"
#include "support/test_meshes.hpp"

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
    return folder.file("joint.toml",
                       "condyle = 1\nname = \"knee\"\nkind = \"free\"\njoint = \"knee\"\n"
                       "side = \"right\"\nunits = \"" +
                           std::string(units) + "\"\n[fixed]\n" + std::string(fixed) + "\n[mobile]\n" +
                           std::string(mobile) +
                           "\n[frame]\ncentre = [1, 2, 3]\nanterior = [0, 1, 0]\n"
                           "superior = [0, 0, 1]\n" +
                           std::string(more));
  }
  std::string refusal(std::string_view fixed) const {
    const auto path = write(fixed, "mesh = \"tibia.ply\"");
    try {
      io::read_joint(path);
    } catch (const FileError& error) {
      return std::string(error.what()).substr(path.string().size() + 2);
    }
    return "accepted";
  }

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
  for (std::size_t v = 0; v < common.mobile.mesh.vertices().size(); ++v)
    EXPECT_LE((own.mobile.mesh.vertices()[v] - common.mobile.mesh.vertices()[v]).cwiseAbs().maxCoeff(),
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
  const std::string mesh = "mesh = \"femur.ply\"\n";
  EXPECT_EQ(refusal(mesh + "pose = [1, 2]"),
            "line 9: fixed.pose: must be a list of sixteen numbers, not of 2");
  EXPECT_EQ(refusal(mesh + "pose = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 2, 0, 0, 0, 0, 1]"),
            "line 9: fixed.pose: the rotation of the matrix is not orthonormal: off by 3, more than 1e-06");
  EXPECT_EQ(refusal(mesh + "pose = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1]"),
            "line 9: fixed.pose: the matrix mirrors: its determinant is -1");
  EXPECT_EQ(
      refusal(mesh + "pose = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 5, -6, 7, 1]"),
      "line 9: fixed.pose: the last row of the matrix must be 0 0 0 1, not 5 -6 7 1: it looks transposed");
  EXPECT_EQ(refusal(mesh + "pose = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 2]"),
            "line 9: fixed.pose: the last row of the matrix must be 0 0 0 1, not 0 0 0 2");
  EXPECT_EQ(refusal(mesh + "pose = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, \"7\", 0, 0, 0, 1]"),
            "line 9: fixed.pose: must be a number, not a text");
  EXPECT_EQ(refusal(mesh + "pose = [1, 0, 0, nan, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]"),
            "line 9: fixed.pose: must be a finite number");
  EXPECT_EQ(refusal(mesh + "pose = [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]"),
            "line 9: fixed.pose: must be a list of sixteen numbers, not of 4");
  EXPECT_EQ(refusal(mesh + "pose = { translation = [5, -6] }"),
            "line 9: fixed.pose.translation: must be a list of three numbers, not of 2");
  EXPECT_EQ(refusal(mesh + "pose = { flexion = \"30\" }"),
            "line 9: fixed.pose.flexion: must be a number, not a text");
  EXPECT_EQ(refusal(mesh + "pose = \"scan\""), "line 9: fixed.pose: must be a table, not a text");
  EXPECT_NE(refusal(mesh + "pose = { dorsiflexion = 3 }").find("unknown key"), std::string::npos);
  EXPECT_NE(refusal(mesh + "poze = 1").find("unknown key (did you mean \"pose\"?)"), std::string::npos)
      << refusal(mesh + "poze = 1");
}

TEST_F(JointBodyPose, AnswersInTheSourceFrameLieOnTheFiles) {
  const io::LoadedJoint loaded = io::read_joint(write(quarter_turn + std::string(plain_femur), plain_tibia));
  const io::Provenance from = io::provenance_of(loaded, {}, io::AnswerFrameName::source);
  const TriMesh fixed = from.frame.fixed_mesh(loaded.joint.fixed.mesh);
  for (std::size_t v = 0; v < fixed.vertices.size(); ++v) {
    EXPECT_EQ(fixed.vertices[v], femur().vertices[v]);
    const Vec3 placed = from.fixed.joint_from_source * femur().vertices[v];
    EXPECT_EQ(placed, loaded.joint.fixed.mesh.vertices()[v]);
  }
}

TEST_F(JointBodyPose, AMatrixOfFewDigitsIsMadeARotationWithANote) {
  const io::LoadedJoint loaded =
      io::read_joint(write("pose = [0.8660254, -0.5, 0, 0, 0.5, 0.8660254, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]\n" +
                               std::string(plain_femur),
                           plain_tibia));
  ASSERT_EQ(loaded.report.processing.size(), 1u);
  EXPECT_NE(loaded.report.processing[0].find("fixed.pose: its rotation was off by"), std::string::npos);
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
