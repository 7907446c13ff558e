#include "condyle/joint_coordinates.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "core/predicates.hpp"

namespace condyle {
namespace {

constexpr Side sides[] = {Side::right, Side::left};

JointAngles degrees(double flexion, double adduction, double rotation) {
  return {Angle::degrees(flexion), Angle::degrees(adduction), Angle::degrees(rotation)};
}

/// The same pose from three rotations about single axes, as the definition reads.
Pose by_definition(Side side, const JointAngles& a) {
  const double s = side == Side::right ? 1 : -1;
  return Pose(Eigen::AngleAxisd(a.flexion.radians(), Vec3::UnitZ()) *
              Eigen::AngleAxisd(a.adduction.radians(), s * Vec3::UnitX()) *
              Eigen::AngleAxisd(a.internal_rotation.radians(), s * Vec3::UnitY()));
}

double largest_difference(const Pose& a, const Pose& b) {
  return (a.matrix() - b.matrix()).cwiseAbs().maxCoeff();
}

/// An entry of pose_at() is a sum of two products of up to three numbers of magnitude at most 1, each off by
/// u/2 of rounding its sine or cosine: 3u/2 + 2u per product, and u for the sum; 8u covers both. AngleAxis
/// goes through quaternions and some ten products more.
constexpr double pose_tolerance = 8 * core::rounding_unit;
constexpr double definition_tolerance = 32 * core::rounding_unit;

/// angles_at() reads adduction with both its sine and cosine: off by the entries' own error and its own
/// rounding (pi u). The pose made of the angles again is off by the sum of the errors of three angles and of
/// pose_at().
constexpr double angle_tolerance = pose_tolerance + 4 * core::rounding_unit;
constexpr double round_trip_tolerance = 4 * angle_tolerance + pose_tolerance;

void expect_both_ways(Side side, const JointAngles& a) {
  const Pose X = pose_at(side, a);
  const JointAngles back = angles_at(side, X);
  EXPECT_GT(back.flexion.degrees(), -180);
  EXPECT_LE(back.flexion.degrees(), 180);
  EXPECT_GE(back.adduction.degrees(), -90);
  EXPECT_LE(back.adduction.degrees(), 90);
  EXPECT_GT(back.internal_rotation.degrees(), -180);
  EXPECT_LE(back.internal_rotation.degrees(), 180);
  EXPECT_LE(largest_difference(pose_at(side, back), X), round_trip_tolerance);
  EXPECT_NEAR(back.adduction.radians(), a.adduction.radians(), angle_tolerance);
  // Flexion and rotation are read from entries that shrink with cos(adduction).
  const double cosine = std::cos(a.adduction.radians());
  if (cosine < 1e-12) return;
  EXPECT_NEAR(std::remainder(back.flexion.radians() - a.flexion.radians(), two_pi), 0,
              angle_tolerance / cosine);
  EXPECT_NEAR(std::remainder(back.internal_rotation.radians() - a.internal_rotation.radians(), two_pi), 0,
              2 * angle_tolerance / cosine);
}

TEST(JointCoordinates, ZeroAnglesAreTheIdentityBitForBit) {
  for (const Side side : sides) {
    const Pose X = pose_at(side, {});
    for (int i = 0; i < 16; ++i) {
      EXPECT_EQ(X.matrix().data()[i], Pose::Identity().matrix().data()[i]);
      EXPECT_FALSE(std::signbit(X.matrix().data()[i]));
    }
  }
}

TEST(JointCoordinates, QuarterTurnsHaveNoRounding) {
  for (const Side side : sides)
    for (int f = -180; f <= 180; f += 90)
      for (int a = -90; a <= 90; a += 90)
        for (int r = -180; r <= 180; r += 90) {
          const Pose X = pose_at(side, degrees(f, a, r));
          const Eigen::Matrix3d whole = X.linear().array().round();
          EXPECT_TRUE(X.linear() == whole) << f << ' ' << a << ' ' << r;
          EXPECT_EQ(X.linear().cwiseAbs().sum(), 3);
          EXPECT_LE(largest_difference(X, by_definition(side, degrees(f, a, r))), definition_tolerance);
          EXPECT_TRUE(pose_at(side, angles_at(side, X)).matrix() == X.matrix());
        }
}

TEST(JointCoordinates, ATinyAngleIsNotTakenForZero) {
  const Pose X = pose_at(Side::right, {Angle::radians(1e-300), Angle(), Angle()});
  EXPECT_EQ(X(1, 0), 1e-300);
}

TEST(JointCoordinates, APoseIsFlexionThenAdductionThenRotationAboutTheStatedAxes) {
  for (const Side side : sides)
    for (int f = -170; f <= 180; f += 35)
      for (int a = -90; a <= 90; a += 15)
        for (int r = -170; r <= 180; r += 35)
          EXPECT_LE(
              largest_difference(pose_at(side, degrees(f, a, r)), by_definition(side, degrees(f, a, r))),
              definition_tolerance);
}

TEST(JointCoordinates, FlexionBringsTheFemurForwardsOnBothSides) {
  for (const Side side : sides) {
    const Vec3 knee = posed(pose_at(side, degrees(90, 0, 0)), Vec3(0, -400, 0));
    EXPECT_EQ(knee, Vec3(400, 0, 0));
  }
}

TEST(JointCoordinates, AdductionBringsTheKneeToTheMidlineOnBothSides) {
  // The midline is to the left (-Z) of a right hip and to the right (+Z) of a left one.
  EXPECT_EQ(posed(pose_at(Side::right, degrees(0, 90, 0)), Vec3(0, -400, 0)), Vec3(0, 0, -400));
  EXPECT_EQ(posed(pose_at(Side::left, degrees(0, 90, 0)), Vec3(0, -400, 0)), Vec3(0, 0, 400));
}

TEST(JointCoordinates, InternalRotationBringsTheFrontToTheMidlineOnBothSides) {
  EXPECT_EQ(posed(pose_at(Side::right, degrees(0, 0, 90)), Vec3(30, 0, 0)), Vec3(0, 0, -30));
  EXPECT_EQ(posed(pose_at(Side::left, degrees(0, 0, 90)), Vec3(30, 0, 0)), Vec3(0, 0, 30));
}

TEST(JointCoordinates, ALeftJointIsTheMirrorImageOfARightOne) {
  const Eigen::Matrix3d mirror = Vec3(1, 1, -1).asDiagonal();
  for (int f = -150; f <= 150; f += 50)
    for (int a = -90; a <= 90; a += 30)
      for (int r = -150; r <= 150; r += 50) {
        // Flexion is about Z in either, which mirroring in Z leaves; the other two axes are mirrored.
        const Eigen::Matrix3d right = pose_at(Side::right, degrees(f, a, r)).linear();
        const Eigen::Matrix3d left = pose_at(Side::left, degrees(f, a, r)).linear();
        EXPECT_TRUE(left == mirror * right * mirror);
      }
}

TEST(JointCoordinates, PosesAndAnglesAgreeBothWaysOverTheWholeRange) {
  for (const Side side : sides)
    for (int f = -180; f <= 180; f += 15)
      for (int a = -90; a <= 90; a += 10)
        for (int r = -180; r <= 180; r += 15) expect_both_ways(side, degrees(f, a, r));
}

RC_GTEST_PROP(JointCoordinates, PosesAndAnglesAgreeBothWaysAnywhere, ()) {
  const auto within = [](int limit) {
    return *rc::gen::inRange(-limit * 1000000, limit * 1000000 + 1) * 1e-6;
  };
  const JointAngles angles = degrees(within(180), within(90), within(180));
  for (const Side side : sides) expect_both_ways(side, angles);
  RC_ASSERT(!::testing::Test::HasFailure());
}

TEST(JointCoordinates, PosesJustBesideTheGimbalPoseAreReproduced) {
  for (const Side side : sides)
    for (const double pole : {-90.0, 90.0})
      for (int exponent = -17; exponent <= 0; ++exponent)
        for (int f = -180; f <= 180; f += 45)
          for (int r = -180; r <= 180; r += 45) {
            const double beside = pole - std::copysign(std::pow(10, exponent), pole);
            expect_both_ways(side, degrees(f, beside, r));
          }
}

TEST(JointCoordinates, AtTheGimbalPoseTheWholeRotationIsGivenToFlexion) {
  for (const Side side : sides)
    for (const double pole : {-90.0, 90.0}) {
      // At +90 of a right joint the pose fixes f + r, at -90 f - r; of a left one, where rotation is negated,
      // the same.
      const JointAngles back = angles_at(side, pose_at(side, degrees(20, pole, 30)));
      EXPECT_EQ(back.internal_rotation.radians(), 0);
      EXPECT_DOUBLE_EQ(back.adduction.degrees(), pole);
      EXPECT_NEAR(back.flexion.degrees(), pole > 0 ? 50 : -10, Angle::radians(angle_tolerance).degrees());
    }
}

TEST(JointCoordinates, AHalfTurnIsGivenAs180NotAsMinus180) {
  for (const Side side : sides) {
    EXPECT_DOUBLE_EQ(angles_at(side, pose_at(side, degrees(-180, 0, 0))).flexion.degrees(), 180);
    EXPECT_DOUBLE_EQ(angles_at(side, pose_at(side, degrees(0, 0, -180))).internal_rotation.degrees(), 180);
  }
}

TEST(JointCoordinates, AnglesReadTheRotationOnly) {
  Pose X = pose_at(Side::left, degrees(40, -20, 10));
  const JointAngles before = angles_at(Side::left, X);
  X.translation() = Vec3(1, 2, 3);
  EXPECT_EQ(angles_at(Side::left, X), before);
}

/// Adding d to one angle is rotating the posed body by d about that angle's axis.
TEST(JointCoordinates, AnAxisIsTheOneAboutWhichItsAngleRotates) {
  const double rotations[] = {0.5, -120, 1e-3};
  for (const Side side : sides)
    for (int f = -180; f <= 180; f += 45)
      for (int a = -90; a <= 90; a += 30)
        for (int r = -180; r <= 180; r += 45)
          for (const double rotation : rotations) {
            const JointAngles at = degrees(f, a, r);
            JointAngles moved[3] = {at, at, at};
            moved[0].flexion = at.flexion + Angle::degrees(rotation);
            moved[1].adduction = at.adduction + Angle::degrees(rotation);
            moved[2].internal_rotation = at.internal_rotation + Angle::degrees(rotation);
            for (const auto angle :
                 {JointAngle::flexion, JointAngle::adduction, JointAngle::internal_rotation}) {
              const Vec3 axis = axis_of(angle, side, at);
              EXPECT_NEAR(axis.norm(), 1, pose_tolerance);
              const Pose rotated(Eigen::AngleAxisd(Angle::degrees(rotation).radians(), axis) *
                                 pose_at(side, at).linear());
              // Rounding of the sum of two angles of up to 2 pi adds 4u.
              EXPECT_LE(largest_difference(rotated, pose_at(side, moved[static_cast<int>(angle)])),
                        definition_tolerance + 4 * core::rounding_unit);
            }
          }
}

}  // namespace
}  // namespace condyle
