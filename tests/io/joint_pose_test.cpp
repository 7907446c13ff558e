#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "condyle/error.hpp"
#include "condyle/io/pose_text.hpp"

namespace condyle {
namespace {

JointAngles degrees(double flexion, double adduction, double rotation) {
  return {Angle::degrees(flexion), Angle::degrees(adduction), Angle::degrees(rotation)};
}

std::string refusal(std::string_view text, JointKind kind = JointKind::ball) {
  try {
    parse_pose(text, kind);
  } catch (const UsageError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(PoseText, ReadsTheThreeAnglesInAnyOrder) {
  const auto expected = degrees(90, -10, 20);
  EXPECT_EQ(parse_pose("flexion=90 adduction=-10 internal_rotation=20", JointKind::ball), expected);
  EXPECT_EQ(parse_pose("internal_rotation=20,flexion=+90,  adduction=-1e1\n", JointKind::ball), expected);
}

TEST(PoseText, AnglesLeftOutAreZero) {
  EXPECT_EQ(parse_pose("", JointKind::ball), degrees(0, 0, 0));
  EXPECT_EQ(parse_pose(" , ", JointKind::ball), degrees(0, 0, 0));
  EXPECT_EQ(parse_pose("adduction=5.5", JointKind::ball), degrees(0, 5.5, 0));
}

TEST(PoseText, ExtensionAbductionAndExternalRotationHaveTheOppositeSign) {
  EXPECT_EQ(parse_pose("extension=15 abduction=40 external_rotation=-30", JointKind::ball),
            degrees(-15, -40, 30));
}

TEST(PoseText, WhatCannotBeMeantIsRefusedByName) {
  EXPECT_EQ(refusal("flexion=10 flexion=20"), "pose: flexion is given twice");
  EXPECT_EQ(refusal("flexion=10 extension=0"), "pose: flexion is given twice");
  EXPECT_EQ(refusal("flexion"), "pose: 'flexion' is not of the form flexion=90");
  EXPECT_EQ(refusal("flexion=").substr(0, 8), "pose: fl");
  for (const char* number :
       {"", "ten", "10deg", "0x10", "--5", "+-5", "-+5", "1e999", "nan", "inf", "-inf", "1.2.3"})
    EXPECT_NE(refusal("flexion=" + std::string(number)), "accepted") << number;
  for (const char* name : {"rotation=5", "Flexion=5", "=5", "flexio=5", "flexion =5"})
    EXPECT_NE(refusal(name), "accepted") << name;
}

TEST(PoseText, RefusalsAreShortAndOnOneLine) {
  const std::string message = refusal(std::string(10000, 'x') + "\x01=5");
  EXPECT_LT(message.size(), 250u);
  EXPECT_EQ(refusal("a\x01\x02=5").find('\x01'), std::string::npos);
}

TEST(PoseText, AHingeRotatesInFlexionOnly) {
  EXPECT_EQ(parse_pose("flexion=30 adduction=0", JointKind::hinge), degrees(30, 0, 0));
  EXPECT_EQ(refusal("flexion=30 adduction=1", JointKind::hinge),
            "pose: a hinge rotates in flexion only, not in adduction");
}

RC_GTEST_PROP(PoseText, WhatIsWrittenReadsBack, ()) {
  const auto angle = [] { return *rc::gen::inRange(-180000000, 180000001) * 1e-6; };
  const JointAngles angles = degrees(angle(), angle(), angle());
  const JointAngles back = parse_pose(to_text(angles), JointKind::ball);
  // Half a unit of the twelfth digit of at most 180 degrees, and rounding far below it.
  const double tolerance = 1.01 * Angle::degrees(0.5e-9).radians();
  RC_ASSERT(std::abs(back.flexion.radians() - angles.flexion.radians()) <= tolerance);
  RC_ASSERT(std::abs(back.adduction.radians() - angles.adduction.radians()) <= tolerance);
  RC_ASSERT(std::abs(back.internal_rotation.radians() - angles.internal_rotation.radians()) <= tolerance);
}

TEST(PoseText, EveryAngleIsFoundByItsName) {
  for (const auto angle : {JointAngle::flexion, JointAngle::adduction, JointAngle::internal_rotation})
    EXPECT_EQ(joint_angle_named(name_of(angle)), angle);
  EXPECT_THROW(joint_angle_named("extension"), UsageError);
}

}  // namespace
}  // namespace condyle
