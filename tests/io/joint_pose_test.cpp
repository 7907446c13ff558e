#include <rapidcheck/gtest.h>

#include <sstream>

#include "condyle/io/pose_text.hpp"
#include "support/test.hpp"

namespace condyle {
namespace {

io::PoseDegrees degrees(double flexion, double adduction, double rotation) {
  return {flexion, adduction, rotation};
}

io::PoseDegrees hip_pose(std::string_view text, JointKind kind = JointKind::ball) {
  return io::parse_pose(text, kind, Anatomy::hip);
}

std::string pose_refusal(std::string_view text, JointKind kind = JointKind::ball) {
  return test::complaint_of<UsageError>([&] { hip_pose(text, kind); });
}

TEST(PoseText, ReadsTheThreeAnglesInAnyOrder) {
  const auto expected = degrees(90, -10, 20);
  EXPECT_EQ(hip_pose("flexion=90 adduction=-10 internal_rotation=20"), expected);
  EXPECT_EQ(hip_pose("internal_rotation=20,flexion=+90,  adduction=-1e1\n"), expected);
}

TEST(PoseText, AnglesLeftOutAreZero) {
  EXPECT_EQ(hip_pose(""), degrees(0, 0, 0));
  EXPECT_EQ(hip_pose(" , "), degrees(0, 0, 0));
  EXPECT_EQ(hip_pose("adduction=5.5"), degrees(0, 5.5, 0));
}

TEST(PoseText, ExtensionAbductionAndExternalRotationHaveTheOppositeSign) {
  EXPECT_EQ(hip_pose("extension=15 abduction=40 external_rotation=-30"), degrees(-15, -40, 30));
}

TEST(PoseText, NoAngleIsMinusNought) {
  const io::PoseDegrees pose = hip_pose("extension=0 adduction=-0 external_rotation=0");
  for (const double angle : {pose.flexion, pose.adduction, pose.internal_rotation})
    EXPECT_FALSE(std::signbit(angle));
  EXPECT_EQ(io::to_text(pose, Anatomy::hip), "flexion=0 adduction=0 internal_rotation=0");
}

/// Through radians and back 57 comes out as 57.00000000000001.
TEST(PoseText, EveryDigitGivenIsKept) {
  ASSERT_NE(Angle::degrees(57).degrees(), 57);
  EXPECT_EQ(io::to_text(hip_pose("flexion=57 adduction=114 internal_rotation=0.1"), Anatomy::hip),
            "flexion=57 adduction=114 internal_rotation=0.1");
}

TEST(PoseText, WhatCannotBeMeantIsRefusedByName) {
  EXPECT_EQ(pose_refusal("flexion=10 flexion=20"), "pose: flexion is given twice");
  EXPECT_EQ(pose_refusal("flexion=10 extension=0"), "pose: flexion is given twice");
  EXPECT_EQ(pose_refusal("flexion"), "pose: 'flexion' is not of the form flexion=90");
  EXPECT_EQ(pose_refusal("flexion=").substr(0, 8), "pose: fl");
  for (const char* number :
       {"", "ten", "10deg", "0x10", "--5", "+-5", "-+5", "1e999", "nan", "inf", "-inf", "1.2.3"})
    EXPECT_NE(pose_refusal("flexion=" + std::string(number)), "accepted") << number;
  for (const char* name : {"rotation=5", "Flexion=5", "=5", "flexio=5", "flexion =5"})
    EXPECT_NE(pose_refusal(name), "accepted") << name;
}

TEST(PoseText, RefusalsAreShortAndOnOneLine) {
  const std::string message = pose_refusal(std::string(10000, 'x') + "\x01=5");
  EXPECT_LT(message.size(), 250u);
  test::expect_silent(pose_refusal("a\x01\x02=5"), "\x01");
}

TEST(PoseText, AHingeRotatesInFlexionOnly) {
  EXPECT_EQ(hip_pose("flexion=30 adduction=0", JointKind::hinge), degrees(30, 0, 0));
  EXPECT_EQ(pose_refusal("flexion=30 adduction=1", JointKind::hinge),
            "pose: a hinge rotates in flexion only, not in adduction");
}

RC_GTEST_PROP(PoseText, WhatIsWrittenReadsBack, ()) {
  // Not only short decimals.
  const auto angle = [] { return *rc::gen::inRange(-180000000, 180000001) * (1e-6 / 3); };
  const io::PoseDegrees pose = degrees(angle(), angle(), angle());
  RC_ASSERT(hip_pose(io::to_text(pose, Anatomy::hip)) == pose);
}

TEST(PoseText, EveryAngleIsFoundByItsName) {
  for (const auto angle : {JointAngle::flexion, JointAngle::adduction, JointAngle::internal_rotation})
    EXPECT_EQ(io::joint_angle_named(name_of(angle, Anatomy::hip), Anatomy::hip), angle);
  EXPECT_THROW(io::joint_angle_named("extension", Anatomy::hip), UsageError);
}

TEST(PoseText, EveryJointHasItsOwnNames) {
  EXPECT_EQ(io::parse_pose("plantarflexion=20 inversion=5", JointKind::ball, Anatomy::ankle),
            degrees(-20, 5, 0));
  EXPECT_EQ(io::parse_pose("flexion=90 valgus=11 pronation=30", JointKind::ball, Anatomy::elbow),
            degrees(90, -11, 30));
  EXPECT_EQ(io::parse_pose("plane_of_elevation=40 elevation=90 external_rotation=10", JointKind::ball,
                           Anatomy::shoulder),
            degrees(40, 90, -10));
  EXPECT_EQ(io::to_text(degrees(1, 2, 3), Anatomy::ankle), "dorsiflexion=1 inversion=2 internal_rotation=3");
  for (const Anatomy joint : all_anatomies)
    for (const JointAngle angle : all_joint_angles)
      EXPECT_EQ(io::joint_angle_named(name_of(angle, joint), joint), angle);
}

TEST(PoseText, ANameOfAnotherJointIsRefusedWithThoseThereAre) {
  EXPECT_EQ(
      test::complaint_of<UsageError>([&] { io::parse_pose("flexion=20", JointKind::ball, Anatomy::ankle); }),
      "pose: unknown angle 'flexion'; there are dorsiflexion, inversion and internal_rotation, and "
      "plantarflexion, eversion and external_rotation with the opposite sign");
}

TEST(PoseText, OnlyAFreeJointTranslates) {
  EXPECT_EQ(io::parse_pose("flexion=30 x=1.5,z=-2 y=+0.25", JointKind::free, Anatomy::knee),
            (io::PoseDegrees{30, 0, 0, {1.5, 0.25, -2}}));
  EXPECT_EQ(io::to_text(io::PoseDegrees{30, 0, 0, {1.5, 0, -2}}, Anatomy::knee),
            "flexion=30 adduction=0 internal_rotation=0 x=1.5 y=0 z=-2");
  EXPECT_NE(pose_refusal("x=1"), "accepted");
  const auto refused = [](std::string_view text) {
    return test::complaint_of<UsageError>([&] { io::parse_pose(text, JointKind::free, Anatomy::knee); });
  };
  EXPECT_EQ(refused("x=1 x=1"), "pose: x is given twice");
  EXPECT_EQ(refused("x=1m"), "pose: x='1m' is not a number of mm");
  for (const char* name : {"xy=1", "w=1", "=1", "X=1"}) EXPECT_NE(refused(name), "accepted") << name;
}

// Poses as matrices.

Joint joint_of(JointKind kind, Anatomy anatomy) {
  Joint joint{"joint", kind, Side::right, {"fixed", TriMesh{}}, {"mobile", TriMesh{}}};
  joint.anatomy = anatomy;
  return joint;
}

std::string matrix_text(const Pose& X) {
  std::ostringstream text;
  text.precision(17);
  for (int i = 0; i < 16; ++i) text << X.matrix()(i / 4, i % 4) << (i % 4 == 3 ? "\n" : " ");
  return text.str();
}

std::string matrix_refusal(const std::string& text, JointKind kind = JointKind::free) {
  const std::string said =
      test::complaint_of<UsageError>([&] { io::given_pose(text, joint_of(kind, Anatomy::knee)); });
  test::expect_silent(said, "\n");
  return said;
}

const JointCoordinates bent{{Angle::degrees(40), Angle::degrees(-3), Angle::degrees(12)}, {1, -2, 3}};

TEST(PoseMatrix, IsThePoseBitForBitAndItsCoordinatesAreTold) {
  const Joint knee = joint_of(JointKind::free, Anatomy::knee);
  const Pose X = pose_at(knee.coordinates(), bent, TranslationFrame::fixed);
  const io::PoseArgument given = io::given_pose(matrix_text(X), knee);
  EXPECT_TRUE(given.X_FM.matrix() == X.matrix());
  EXPECT_TRUE(given.notes.empty());
  EXPECT_NEAR(given.pose.flexion, 40, 1e-12);
  EXPECT_NEAR(given.pose.adduction, -3, 1e-12);
  EXPECT_NEAR(given.pose.internal_rotation, 12, 1e-12);
  EXPECT_EQ(given.pose.translation_mm, Vec3(1, -2, 3));
}

TEST(PoseMatrix, WithSevenDigitsIsMadeARotationAndSaysSo) {
  const Joint knee = joint_of(JointKind::free, Anatomy::knee);
  const Pose X = pose_at(knee.coordinates(), bent, TranslationFrame::fixed);
  Pose rounded = X;
  rounded.matrix() = (X.matrix() * 1e7).array().round() / 1e7;
  const io::PoseArgument given = io::given_pose(matrix_text(rounded), knee);
  ASSERT_EQ(given.notes.size(), 1u);
  test::expect_says(given.notes[0], "the nearest one is used");
  const Eigen::Matrix3d R = given.X_FM.linear();
  EXPECT_LE((R.transpose() * R - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff(), 4e-15);
  EXPECT_LE((R - X.linear()).cwiseAbs().maxCoeff(), 3 * 0.5e-7);
}

TEST(PoseMatrix, ThatIsNoPoseIsRefusedInOneLine) {
  for (const auto& [matrix, says] : std::vector<test::Refusal>{
           {"1 0 0 0 0 1", "a matrix has 16 numbers, row by row, not 6"},
           {"1 0 0 0, 0 1 0 0, 0 0 1 0, 0 0 0 1, 5", "a matrix has 16 numbers, row by row, not 17"},
           {"1 0 0 ten", "'ten' in the matrix is not a finite number"},
           {"1 0 0 nan", "'nan' in the matrix is not a finite number"},
           {"1 0 0 0 0 1 0 0 0 0 1 0 5 6 7 1",
            "the last row of the matrix must be 0 0 0 1, not 5 6 7 1: it looks transposed"},
           {"1 0 0 0 0 1 0 0 0 0 -1 0 0 0 0 1", "the matrix mirrors: its determinant is -1"},
           {"1 0.01 0 0 0 1 0 0 0 0 1 0 0 0 0 1",
            "the rotation of the matrix is not orthonormal: off by 0.01, more than 1e-06"}})
    EXPECT_EQ(matrix_refusal(matrix), "pose: " + says);
}

TEST(PoseMatrix, OfAJointThatDoesNotTranslateHasNoTranslation) {
  EXPECT_EQ(matrix_refusal("1 0 0 5 0 1 0 0 0 0 1 0 0 0 0 1", JointKind::ball),
            "pose: a ball does not translate, and the matrix has (5, 0, 0) mm");
  EXPECT_EQ(matrix_refusal("1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1", JointKind::ball), "accepted");
}

TEST(PoseMatrix, OfAHingeTurnsAboutItsAxis) {
  const Joint hinge = joint_of(JointKind::hinge, Anatomy::knee);
  EXPECT_EQ(io::given_pose("0 1 0 0 -1 0 0 0 0 0 1 0 0 0 0 1", hinge).pose.flexion, 90);
  EXPECT_EQ(matrix_refusal("1 0 0 0 0 0 -1 0 0 1 0 0 0 0 0 1", JointKind::hinge),
            "pose: a hinge rotates in flexion only, not in adduction");
}

}  // namespace
}  // namespace condyle
