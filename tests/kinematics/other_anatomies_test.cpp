#include "kinematics/ankle_anatomy.hpp"
#include "kinematics/elbow_anatomy.hpp"
#include "kinematics/shoulder_anatomy.hpp"
#include "support/drawn_bones.hpp"
#include "support/test.hpp"

/// Drawn ankles, elbows and shoulders with known axes, turned at random and with noise.

namespace condyle::kinematics {
namespace {

using test::degrees_between, test::scanned;

/// Largest errors of an axis and a place that are inferred.
constexpr double anatomy_most_deg = 3, anatomy_most_mm = 2, noise = 0.3;

double degrees_between_lines(const Vec3& a, const Vec3& b) {
  const double deg = degrees_between(a, b);
  return std::min(deg, 180 - deg);
}

TEST(AnkleAnatomy, OfADrawnAnkleIsFoundInAnyPose) {
  const TriMesh tibia = test::tibia_of_ankle(), talus = test::talus();
  for (unsigned i = 0; i < 4; ++i) {
    SCOPED_TRACE(testing::Message() << "pose " << i);
    const Pose X = test::any_pose(i);
    const AnkleAnatomy ankle = ankle_anatomy(scanned(tibia, X, noise, i), scanned(talus, X, noise, i + 9));
    ASSERT_TRUE(ankle.dome.fit) << ankle.dome.why_none;
    EXPECT_LT((ankle.centre - X.translation()).norm(), anatomy_most_mm);
    ASSERT_TRUE(ankle.axes) << ankle.why_no_axes;
    EXPECT_LT(degrees_between(ankle.axes->right(), X.linear() * Vec3::UnitZ()), anatomy_most_deg);
    EXPECT_LT(degrees_between(ankle.axes->superior, X.linear() * Vec3::UnitY()), anatomy_most_deg);
  }
}

TEST(AnkleAnatomy, WithoutAHeadOrAShaftHasNoDirections) {
  const TriMesh tibia = test::tibia_of_ankle();
  const AnkleAnatomy headless = ankle_anatomy(tibia, test::talus(20));
  ASSERT_TRUE(headless.dome.fit) << headless.dome.why_none;
  EXPECT_FALSE(headless.axes);
  EXPECT_EQ(headless.why_no_axes, "the talus reaches as far to the front as to the back of its dome");
  const AnkleAnatomy cut = ankle_anatomy(test::tibia_of_ankle(50), test::talus());
  ASSERT_TRUE(cut.dome.fit) << cut.dome.why_none;
  EXPECT_FALSE(cut.axes);
}

TEST(AnkleAnatomy, OfATalusWithoutADomeIsEmpty) {
  const AnkleAnatomy ankle = ankle_anatomy(test::tibia_of_ankle(), test::box({-19, -18, -15}, {19, 18, 15}));
  EXPECT_FALSE(ankle.dome.fit);
  EXPECT_FALSE(ankle.dome.why_none.empty());
}

/// A tibia is round about its shaft too.
TEST(AnkleAnatomy, OfExchangedBonesIsEmpty) {
  const AnkleAnatomy ankle = ankle_anatomy(test::talus(), test::tibia_of_ankle());
  EXPECT_FALSE(ankle.dome.fit);
  test::expect_says(ankle.dome.why_none, "a dome lies across");
}

TEST(ElbowAnatomy, OfADrawnElbowIsFoundInAnyPose) {
  const TriMesh humerus = test::humerus_at_elbow(), ulna = test::ulna();
  for (unsigned i = 0; i < 4; ++i) {
    SCOPED_TRACE(testing::Message() << "pose " << i);
    const Pose X = test::any_pose(i);
    const ElbowAnatomy elbow = elbow_anatomy(scanned(humerus, X, noise, i), scanned(ulna, X, noise, i + 9));
    ASSERT_TRUE(elbow.trochlea.fit) << elbow.trochlea.why_none;
    EXPECT_LT((elbow.centre - X.translation()).norm(), anatomy_most_mm);
    EXPECT_LT(degrees_between_lines(elbow.trochlea.fit->cylinder.direction, X.linear() * Vec3::UnitZ()),
              anatomy_most_deg);
    ASSERT_TRUE(elbow.superior) << elbow.why_no_superior;
    EXPECT_LT(degrees_between(*elbow.superior, X.linear() * Vec3::UnitY()), anatomy_most_deg);
    EXPECT_LT(degrees_between(*elbow.from_shaft_line, X.linear() * Vec3::UnitX()), anatomy_most_deg);
    EXPECT_NEAR(elbow.off_shaft_line_mm, 9, anatomy_most_mm);
  }
}

TEST(ElbowAnatomy, OfExchangedBonesIsEmpty) {
  EXPECT_FALSE(elbow_anatomy(test::ulna(), test::humerus_at_elbow()).trochlea.fit);
}

TEST(ShoulderAnatomy, OfADrawnShoulderIsFoundInAnyPose) {
  const TriMesh humerus = test::humerus_at_shoulder(), scapula = test::scapula();
  for (unsigned i = 0; i < 4; ++i) {
    SCOPED_TRACE(testing::Message() << "pose " << i);
    const Pose X = test::any_pose(i);
    const ShoulderAnatomy shoulder =
        shoulder_anatomy(scanned(scapula, X, noise, i), scanned(humerus, X, noise, i + 9));
    ASSERT_TRUE(shoulder.head) << shoulder.why_no_head;
    EXPECT_LT((shoulder.head->fit.sphere.centre - X.translation()).norm(), anatomy_most_mm);
    EXPECT_NEAR(shoulder.head->fit.sphere.radius, 24, 0.5);
    ASSERT_TRUE(shoulder.glenoid) << shoulder.why_no_glenoid;
    EXPECT_LT((shoulder.glenoid->fit.sphere.centre - X * Vec3(0, 0, 3)).norm(), anatomy_most_mm);
    EXPECT_NEAR(shoulder.glenoid->fit.sphere.radius, 30, anatomy_most_mm);
    EXPECT_LT(degrees_between(shoulder.glenoid->faces, X.linear() * Vec3::UnitZ()), anatomy_most_deg);
    EXPECT_LT(degrees_between(*shoulder.towards_humerus, X.linear() * -Vec3::UnitY()), 20);
  }
}

TEST(ShoulderAnatomy, OfExchangedBonesHasNoHead) {
  EXPECT_FALSE(shoulder_anatomy(test::humerus_at_shoulder(), test::scapula()).head);
}

TEST(ShoulderAnatomy, OfABoxHasNoGlenoid) {
  const ShoulderAnatomy shoulder =
      shoulder_anatomy(test::box({-20, -20, -80}, {20, 20, -60}), test::humerus_at_shoulder());
  EXPECT_FALSE(shoulder.glenoid);
  EXPECT_FALSE(shoulder.why_no_glenoid.empty());
}

}  // namespace
}  // namespace condyle::kinematics
