#include "condyle/joint_coordinates.hpp"

#include <rapidcheck/gtest.h>

#include "core/predicates.hpp"
#include "support/test.hpp"

namespace condyle {
namespace {

constexpr Side sides[] = {Side::right, Side::left};

JointAngles degrees(double flexion, double adduction, double rotation) {
  return {Angle::degrees(flexion), Angle::degrees(adduction), Angle::degrees(rotation)};
}

std::vector<CoordinateSystem> all_systems() {
  std::vector<CoordinateSystem> systems;
  for (const Anatomy anatomy : all_anatomies)
    for (const Side side : sides) systems.push_back({anatomy, side});
  return systems;
}

/// Three rotations about single axes, as the header reads.
Pose by_definition(CoordinateSystem system, const JointAngles& a) {
  const double s = system.side == Side::right ? 1 : -1;
  const Vec3 x = s * Vec3::UnitX(), y = s * Vec3::UnitY(), z = Vec3::UnitZ();
  const auto turn = [](Angle angle, const Vec3& axis) { return Eigen::AngleAxisd(angle.radians(), axis); };
  if (system.anatomy == Anatomy::shoulder)
    return Pose(turn(a.flexion, y) * turn(-a.adduction, x) * turn(a.internal_rotation, y));
  const double bends = system.anatomy == Anatomy::knee ? -1 : 1;
  return Pose(turn(a.flexion * bends, z) * turn(a.adduction, x) * turn(a.internal_rotation, y));
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
  const Pose X = pose_at({.side = side}, a);
  const JointAngles back = angles_at({.side = side}, X);
  EXPECT_GT(back.flexion.degrees(), -180);
  EXPECT_LE(back.flexion.degrees(), 180);
  EXPECT_GE(back.adduction.degrees(), -90);
  EXPECT_LE(back.adduction.degrees(), 90);
  EXPECT_GT(back.internal_rotation.degrees(), -180);
  EXPECT_LE(back.internal_rotation.degrees(), 180);
  EXPECT_LE(largest_difference(pose_at({.side = side}, back), X), round_trip_tolerance);
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
    const Pose X = pose_at({.side = side}, {});
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
          const Pose X = pose_at({.side = side}, degrees(f, a, r));
          const Eigen::Matrix3d whole = X.linear().array().round();
          EXPECT_TRUE(X.linear() == whole) << f << ' ' << a << ' ' << r;
          EXPECT_EQ(X.linear().cwiseAbs().sum(), 3);
          EXPECT_LE(largest_difference(X, by_definition({.side = side}, degrees(f, a, r))),
                    definition_tolerance);
          EXPECT_TRUE(pose_at({.side = side}, angles_at({.side = side}, X)).matrix() == X.matrix());
        }
}

TEST(JointCoordinates, ATinyAngleIsNotTakenForZero) {
  const Pose X = pose_at({.side = Side::right}, {Angle::radians(1e-300), Angle(), Angle()});
  EXPECT_EQ(X(1, 0), 1e-300);
}

TEST(JointCoordinates, ALeftJointIsTheMirrorImageOfARightOne) {
  const Eigen::Matrix3d mirror = Vec3(1, 1, -1).asDiagonal();
  for (int f = -150; f <= 150; f += 50)
    for (int a = -90; a <= 90; a += 30)
      for (int r = -150; r <= 150; r += 50) {
        // Flexion is about Z in either, which mirroring in Z leaves; the other two axes are mirrored.
        const Eigen::Matrix3d right = pose_at({.side = Side::right}, degrees(f, a, r)).linear();
        const Eigen::Matrix3d left = pose_at({.side = Side::left}, degrees(f, a, r)).linear();
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
      const JointAngles back = angles_at({.side = side}, pose_at({.side = side}, degrees(20, pole, 30)));
      EXPECT_EQ(back.internal_rotation.radians(), 0);
      EXPECT_DOUBLE_EQ(back.adduction.degrees(), pole);
      EXPECT_NEAR(back.flexion.degrees(), pole > 0 ? 50 : -10, Angle::radians(angle_tolerance).degrees());
    }
}

TEST(JointCoordinates, AHalfTurnIsGivenAs180NotAsMinus180) {
  for (const Side side : sides) {
    EXPECT_DOUBLE_EQ(
        angles_at({.side = side}, pose_at({.side = side}, degrees(-180, 0, 0))).flexion.degrees(), 180);
    EXPECT_DOUBLE_EQ(
        angles_at({.side = side}, pose_at({.side = side}, degrees(0, 0, -180))).internal_rotation.degrees(),
        180);
  }
}

TEST(JointCoordinates, AnglesReadTheRotationOnly) {
  Pose X = pose_at({.side = Side::left}, degrees(40, -20, 10));
  const JointAngles before = angles_at({.side = Side::left}, X);
  X.translation() = Vec3(1, 2, 3);
  EXPECT_EQ(angles_at({.side = Side::left}, X), before);
}

/// Checks the point p of the mobile body on either side, at its place in a right joint and mirrored in a left one.
void expect_on_both_sides(Anatomy anatomy, const JointAngles& angles, const Vec3& p, const Vec3& moved) {
  const Eigen::DiagonalMatrix<double, 3> mirror(1, 1, -1);
  EXPECT_EQ(posed(pose_at({anatomy, Side::right}, angles), p), moved);
  EXPECT_EQ(posed(pose_at({anatomy, Side::left}, angles), Vec3(mirror * p)), mirror * moved);
}

constexpr double below = -400, in_front = 150;
const Vec3 distal(0, below, 0), front(in_front, 0, 0);

TEST(JointCoordinates, AHipFlexesForwardsAndAdductsAndRotatesTowardsTheMidline) {
  expect_on_both_sides(Anatomy::hip, degrees(90, 0, 0), distal, {-below, 0, 0});
  // The midline is to the left (-Z) of a right hip and to the right (+Z) of a left one.
  expect_on_both_sides(Anatomy::hip, degrees(0, 90, 0), distal, {0, 0, below});
  expect_on_both_sides(Anatomy::hip, degrees(0, 0, 90), front, {0, 0, -in_front});
}

TEST(JointCoordinates, AKneeFlexesBackwards) {
  expect_on_both_sides(Anatomy::knee, degrees(90, 0, 0), distal, {below, 0, 0});
}

TEST(JointCoordinates, AKneeAdductsAndRotatesTowardsTheMidline) {
  expect_on_both_sides(Anatomy::knee, degrees(0, 90, 0), distal, {0, 0, below});
  expect_on_both_sides(Anatomy::knee, degrees(0, 0, 90), front, {0, 0, -in_front});
}

TEST(JointCoordinates, DorsiflexionLiftsTheToes) {
  expect_on_both_sides(Anatomy::ankle, degrees(90, 0, 0), front, {0, in_front, 0});
}

TEST(JointCoordinates, InversionTurnsTheSoleAndInternalRotationTheToesToTheMidline) {
  expect_on_both_sides(Anatomy::ankle, degrees(0, 90, 0), distal, {0, 0, below});
  expect_on_both_sides(Anatomy::ankle, degrees(0, 0, 90), front, {0, 0, -in_front});
}

TEST(JointCoordinates, AnElbowFlexesForwards) {
  expect_on_both_sides(Anatomy::elbow, degrees(90, 0, 0), distal, {-below, 0, 0});
}

TEST(JointCoordinates, VarusTakesTheHandToTheMidlineAndPronationTurnsThePalmThere) {
  expect_on_both_sides(Anatomy::elbow, degrees(0, 90, 0), distal, {0, 0, below});
  // With the arm hanging and the palm forwards.
  expect_on_both_sides(Anatomy::elbow, degrees(0, 0, 90), front, {0, 0, -in_front});
}

TEST(JointCoordinates, AnArmIsElevatedSidewaysInPlaneNoughtAndForwardsInPlaneNinety) {
  expect_on_both_sides(Anatomy::shoulder, degrees(0, 90, 0), distal, {0, 0, -below});
  expect_on_both_sides(Anatomy::shoulder, degrees(90, 90, 0), distal, {-below, 0, 0});
  expect_on_both_sides(Anatomy::shoulder, degrees(-90, 90, 0), distal, {below, 0, 0});
  expect_on_both_sides(Anatomy::shoulder, degrees(40, 180, 0), distal, {0, -below, 0});
}

TEST(JointCoordinates, AHangingArmRotatesItsFrontInwardsAndSoItDoesElevated) {
  expect_on_both_sides(Anatomy::shoulder, degrees(0, 0, 90), front, {0, 0, -in_front});
  // Abducted to the horizontal, the palm in front goes down.
  expect_on_both_sides(Anatomy::shoulder, degrees(0, 90, 90), front, {0, -in_front, 0});
}

TEST(JointCoordinates, EverySystemIsItsThreeRotations) {
  for (const CoordinateSystem system : all_systems())
    for (int f = -170; f <= 180; f += 35)
      for (int a = -90; a <= 180; a += 15)
        for (int r = -170; r <= 180; r += 35)
          EXPECT_LE(
              largest_difference(pose_at(system, degrees(f, a, r)), by_definition(system, degrees(f, a, r))),
              definition_tolerance);
}

/// R = R_z(-f) R_x(a) R_y(r), written out for f = 30, a = 0, r = 0 and f = 0, a = 0, r = 30.
TEST(JointCoordinates, AKneesMatrixIsTheOneOfItsDefinition) {
  const double s = 0.5, c = std::sqrt(3) / 2;
  Eigen::Matrix3d bent, rotated;
  bent << c, s, 0, -s, c, 0, 0, 0, 1;
  rotated << c, 0, s, 0, 1, 0, -s, 0, c;
  const CoordinateSystem knee{Anatomy::knee, Side::right};
  EXPECT_LE((pose_at(knee, degrees(30, 0, 0)).linear() - bent).cwiseAbs().maxCoeff(), pose_tolerance);
  EXPECT_LE((pose_at(knee, degrees(0, 0, 30)).linear() - rotated).cwiseAbs().maxCoeff(), pose_tolerance);
}

void expect_pose_again(CoordinateSystem system, const JointAngles& angles) {
  const Pose X = pose_at(system, angles);
  const JointAngles back = angles_at(system, X);
  const bool shoulder = system.anatomy == Anatomy::shoulder;
  for (const Angle angle : {back.flexion, back.internal_rotation}) {
    EXPECT_GT(angle.degrees(), -180);
    EXPECT_LE(angle.degrees(), 180);
  }
  EXPECT_GE(back.adduction.degrees(), shoulder ? 0 : -90);
  EXPECT_LE(back.adduction.degrees(), shoulder ? 180 : 90);
  EXPECT_LE(largest_difference(pose_at(system, back), X), round_trip_tolerance);
}

TEST(JointCoordinates, EverySystemReproducesItsPoses) {
  for (const CoordinateSystem system : all_systems())
    for (int f = -180; f <= 180; f += 30)
      for (int a = -180; a <= 180; a += 15)
        for (int r = -180; r <= 180; r += 30) expect_pose_again(system, degrees(f, a, r));
}

TEST(JointCoordinates, TheAnglesOfAShoulderAreFoundAgain) {
  for (const Side side : sides)
    for (const double elevation : {1e-3, 20.0, 90.0, 179.0})
      for (int p = -170; p <= 180; p += 35)
        for (int r = -170; r <= 180; r += 35) {
          const JointAngles angles = degrees(p, elevation, r);
          const JointAngles back =
              angles_at({Anatomy::shoulder, side}, pose_at({Anatomy::shoulder, side}, angles));
          // The plane is read from entries that shrink with sin(elevation).
          const double sine = std::sin(angles.adduction.radians());
          EXPECT_NEAR(back.flexion.radians(), angles.flexion.radians(), angle_tolerance / sine);
          EXPECT_NEAR(back.adduction.radians(), angles.adduction.radians(), angle_tolerance);
          EXPECT_NEAR(back.internal_rotation.radians(), angles.internal_rotation.radians(),
                      2 * angle_tolerance / sine);
        }
}

TEST(JointCoordinates, ShouldersJustBesideTheirPolesAreReproduced) {
  for (const Side side : sides)
    for (const double pole : {0.0, 180.0})
      for (int exponent = -17; exponent <= 0; ++exponent)
        for (int p = -180; p <= 180; p += 45)
          for (int r = -180; r <= 180; r += 45)
            expect_pose_again({Anatomy::shoulder, side},
                              degrees(p, std::abs(pole - std::pow(10, exponent)), r));
}

TEST(JointCoordinates, AHangingArmHasNoPlaneAndAllOfItsRotation) {
  for (const Side side : sides) {
    const CoordinateSystem shoulder{Anatomy::shoulder, side};
    const JointAngles hanging = angles_at(shoulder, pose_at(shoulder, degrees(20, 0, 30)));
    EXPECT_EQ(hanging.flexion.radians(), 0);
    EXPECT_EQ(hanging.adduction.radians(), 0);
    EXPECT_NEAR(hanging.internal_rotation.degrees(), 50, Angle::radians(angle_tolerance).degrees());
    const JointAngles upright = angles_at(shoulder, pose_at(shoulder, degrees(20, 180, 30)));
    EXPECT_EQ(upright.flexion.radians(), 0);
    EXPECT_DOUBLE_EQ(upright.adduction.degrees(), 180);
    EXPECT_NEAR(upright.internal_rotation.degrees(), 10, Angle::radians(angle_tolerance).degrees());
  }
}

/// Adding d to one angle is rotating the posed body by d about that angle's axis.
TEST(JointCoordinates, InEverySystemAnAngleRotatesAboutItsAxis) {
  for (const CoordinateSystem system : all_systems())
    for (int f = -180; f <= 180; f += 45)
      for (int a = -90; a <= 180; a += 30)
        for (int r = -180; r <= 180; r += 45)
          for (const Angle by : {Angle::degrees(0.5), Angle::degrees(-120), Angle::degrees(1e-3)}) {
            const JointAngles at = degrees(f, a, r);
            JointAngles moved[3] = {at, at, at};
            moved[0].flexion = at.flexion + by;
            moved[1].adduction = at.adduction + by;
            moved[2].internal_rotation = at.internal_rotation + by;
            for (const JointAngle angle : all_joint_angles) {
              const Vec3 axis = axis_of(angle, system, at);
              EXPECT_NEAR(axis.norm(), 1, pose_tolerance);
              const Pose rotated(Eigen::AngleAxisd(by.radians(), axis) * pose_at(system, at).linear());
              // Rounding of the sum of two angles of up to 2 pi adds 4u.
              EXPECT_LE(largest_difference(rotated, pose_at(system, moved[static_cast<int>(angle)])),
                        definition_tolerance + 4 * core::rounding_unit);
            }
          }
}

TEST(JointCoordinates, NoNameMeansTwoThingsInOneJoint) {
  for (const Anatomy anatomy : all_anatomies) {
    std::set<std::string_view> names;
    for (const auto& [positive, negative] : coordinate_names(anatomy)) {
      EXPECT_FALSE(positive.empty() || negative.empty());
      names.insert({positive, negative});
    }
    EXPECT_EQ(names.size(), 6u);
  }
}

// Translations.

TEST(JointCoordinates, ATranslationMovesTheMobileBodysOriginAlongTheAxesOfF) {
  const JointCoordinates at{degrees(40, 10, -20), {1, -2, 3}};
  for (const CoordinateSystem system : all_systems()) {
    const Pose X = pose_at(system, at, TranslationFrame::fixed);
    EXPECT_EQ(posed(X, Vec3(0, 0, 0)), Vec3(1, -2, 3));
    EXPECT_TRUE(X.linear() == pose_at(system, at.angles).linear());
  }
}

/// In a bent knee distraction goes along the tibia, a drawer at right angles to it and to the femur's axis.
TEST(JointCoordinates, AlongJointAxesATranslationFollowsTheMobileBody) {
  const CoordinateSystem knee{Anatomy::knee, Side::right};
  const auto moved = [&](const Vec3& t) {
    return posed(pose_at(knee, JointCoordinates{degrees(90, 0, 0), t}, TranslationFrame::joint_axes),
                 Vec3(0, 0, 0));
  };
  EXPECT_EQ(moved({0, 5, 0}), Vec3(5, 0, 0));   // the tibia's long axis points backwards from the foot
  EXPECT_EQ(moved({5, 0, 0}), Vec3(0, -5, 0));  // its front points down
  EXPECT_EQ(moved({0, 0, 5}), Vec3(0, 0, 5));
}

TEST(JointCoordinates, BothTranslationFramesAgreeAtZeroAnglesOnBothSides) {
  for (const CoordinateSystem system : all_systems()) {
    if (system.anatomy == Anatomy::shoulder) continue;
    const JointCoordinates at{{}, {1, 2, 3}};
    EXPECT_TRUE(pose_at(system, at, TranslationFrame::joint_axes).matrix() ==
                pose_at(system, at, TranslationFrame::fixed).matrix());
  }
}

RC_GTEST_PROP(JointCoordinates, CoordinatesWithTranslationsAreFoundAgain, ()) {
  const auto within = [](int limit) {
    return *rc::gen::inRange(-limit * 1000000, limit * 1000000 + 1) * 1e-6;
  };
  const JointCoordinates at{degrees(within(179), within(80), within(179)),
                            {within(50), within(50), within(50)}};
  for (const CoordinateSystem system : all_systems())
    for (const auto frame : {TranslationFrame::fixed, TranslationFrame::joint_axes}) {
      if (system.anatomy == Anatomy::shoulder && frame == TranslationFrame::joint_axes) continue;
      const Pose X = pose_at(system, at, frame);
      const JointCoordinates back = coordinates_at(system, X, frame);
      // Off by some roundings of three numbers of 50 mm, over the squared cosine of 80 degrees where axes are oblique.
      const double tolerance = 50 * 64 * core::rounding_unit / (frame == TranslationFrame::fixed ? 1 : 0.03);
      EXPECT_LE((back.translation_mm - at.translation_mm).cwiseAbs().maxCoeff(), tolerance);
      EXPECT_LE(largest_difference(pose_at(system, back, frame), X), 4 * tolerance);
    }
  RC_ASSERT(!::testing::Test::HasFailure());
}

}  // namespace
}  // namespace condyle
