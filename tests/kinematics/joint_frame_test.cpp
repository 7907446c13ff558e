#include "condyle/make_joint.hpp"

#include <rapidcheck/gtest.h>

#include "core/predicates.hpp"
#include "support/test.hpp"

namespace condyle {
namespace {

/// Products of unit vectors with a few roundings each.
constexpr double orthonormal_tolerance = 16 * core::rounding_unit;

void expect_rotation(const Pose& X) {
  const Eigen::Matrix3d gram = X.linear().transpose() * X.linear();
  EXPECT_LE((gram - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff(), orthonormal_tolerance);
  EXPECT_NEAR(X.linear().determinant(), 1, orthonormal_tolerance);
}

std::string message_of(const Vec3& anterior, const Vec3& superior) {
  return test::complaint_of<UsageError>([&] { frame_from_axes(Vec3::Zero(), anterior, superior); });
}

TEST(JointFrame, StandardAxesAndAnyCentreAreTakenBitForBit) {
  const Vec3 centre(0.1, -1e9, 1.0 / 3);
  const Pose X = frame_from_axes(centre, Vec3::UnitX(), Vec3::UnitY());
  EXPECT_TRUE(X.linear() == Eigen::Matrix3d::Identity());
  EXPECT_TRUE(X.translation() == centre);
}

TEST(JointFrame, AScannersAxesAreTakenBitForBitWithRightAsTheirProduct) {
  // Left, posterior, superior axes of an image: anterior is -y, superior +z, and right must come out as -x.
  const Pose X = frame_from_axes(Vec3::Zero(), -Vec3::UnitY(), Vec3::UnitZ());
  EXPECT_TRUE(X.linear().col(2) == -Vec3::UnitX());
}

TEST(JointFrame, DirectionsWithSixDecimalsAreMadeOrthonormalRotatingBothAlike) {
  const Vec3 anterior(0.866025, 0.5, 0), superior(-0.5, 0.866025, 0);
  const Pose X = frame_from_axes(Vec3::Zero(), anterior, superior);
  expect_rotation(X);
  EXPECT_LE((X.linear().col(0) - anterior).norm(), 2 * axis_tolerance);
  EXPECT_LE((X.linear().col(1) - superior).norm(), 2 * axis_tolerance);
}

RC_GTEST_PROP(JointFrame, EveryFrameRoundedToSixDecimalsIsAccepted, ()) {
  const auto number = [] { return *rc::gen::inRange(-1000000, 1000001) * 1e-6; };
  const Vec3 a(number(), number(), number()), b(number(), number(), number());
  RC_PRE(a.norm() > 0.01 && a.cross(b).norm() > 0.01 * a.norm());
  const Vec3 x = a.normalized(), y = (b - x.dot(b) * x).normalized();
  const auto rounded = [](const Vec3& v) { return Vec3((v * 1e6).array().round() / 1e6); };
  const Pose X = frame_from_axes(Vec3::Zero(), rounded(x), rounded(y));
  expect_rotation(X);
  // Half a unit of the last decimal in each of three numbers, and half of what the right angle is off.
  RC_ASSERT((X.linear().col(0) - x).norm() <= 2 * std::sqrt(3) * 0.5e-6);
  RC_ASSERT((X.linear().col(1) - y).norm() <= 2 * std::sqrt(3) * 0.5e-6);
}

TEST(JointFrame, ATiltedPairIsRefusedSayingByHowMuch) {
  const double one_degree = Angle::degrees(1).radians();
  const std::string message = message_of(Vec3::UnitX(), Vec3(std::sin(one_degree), std::cos(one_degree), 0));
  EXPECT_EQ(message, "anterior and superior are 89 degrees apart, not 90 (off by 1)");
}

TEST(JointFrame, LengthsOtherThanOneAreRefused) {
  EXPECT_EQ(message_of(2 * Vec3::UnitX(), Vec3::UnitY()), "anterior has length 2, not 1");
  EXPECT_EQ(message_of(Vec3::UnitX(), Vec3::Zero()), "superior has length 0, not 1");
}

TEST(JointFrame, TheToleranceIsHeldOnBothSides) {
  EXPECT_EQ(message_of((1 + 0.9 * axis_tolerance) * Vec3::UnitX(), Vec3::UnitY()), "accepted");
  EXPECT_NE(message_of((1 + 1.1 * axis_tolerance) * Vec3::UnitX(), Vec3::UnitY()), "accepted");
  const auto tilted = [](double angle) { return Vec3(std::sin(angle), std::cos(angle), 0); };
  EXPECT_EQ(message_of(Vec3::UnitX(), tilted(1.9 * axis_tolerance)), "accepted");
  EXPECT_NE(message_of(Vec3::UnitX(), tilted(2.1 * axis_tolerance)), "accepted");
}

/// A pelvis standing upright in its own frame: origin between the ASIS, PSIS behind and a little above.
const PelvisLandmarks upright_pelvis{{0, 0, 120}, {0, 0, -120}, {-150, 0, 45}, {-150, 0, -45}};

TEST(JointFrame, ThePelvicFrameOfAnUprightPelvisIsTheStandardOne) {
  const Vec3 centre(-30, -70, 90);
  const Pose X = frame_from_landmarks(centre, upright_pelvis);
  EXPECT_TRUE(X.linear().isApprox(Eigen::Matrix3d::Identity(), orthonormal_tolerance));
  EXPECT_TRUE(X.translation() == centre);
}

RC_GTEST_PROP(JointFrame, FramesFromLandmarksRotateWithTheLandmarks, ()) {
  const auto number = [] { return *rc::gen::inRange(-1000, 1001) * 1e-3; };
  const Eigen::Vector4d q(number(), number(), number(), number());
  RC_PRE(q.norm() > 0.1);
  Pose X = Pose(Eigen::Quaterniond(q).normalized());
  X.translation() = 1000 * Vec3(number(), number(), number());
  const auto at = [&](const Vec3& p) { return posed(X, p); };
  const auto& [ra, la, rp, lp] = upright_pelvis;
  const Vec3 symphysis(20, -90, 3), medial(5, -400, -40), lateral(-3, -398, 45), centre(0, 0, 0);
  // Positions are of order 1000 mm with an error of a few u each, directions of landmarks at least 80 mm
  // apart.
  const double tolerance = 16 * 2000 * core::rounding_unit / 80 + 4 * orthonormal_tolerance;
  const auto expect_same = [&](const Pose& moved, const Pose& still) {
    expect_rotation(moved);
    const Eigen::Matrix3d difference = moved.linear() - X.linear() * still.linear();
    RC_ASSERT(difference.cwiseAbs().maxCoeff() <= tolerance);
  };
  expect_same(frame_from_landmarks(at(centre), PelvisLandmarks{at(ra), at(la), at(rp), at(lp)}),
              frame_from_landmarks(centre, upright_pelvis));
  expect_same(frame_from_landmarks(at(centre), AnteriorPelvicPlane{at(ra), at(la), at(symphysis)}),
              frame_from_landmarks(centre, AnteriorPelvicPlane{ra, la, symphysis}));
  expect_same(frame_from_landmarks(at(centre), Side::right, FemurLandmarks{at(medial), at(lateral)}),
              frame_from_landmarks(centre, Side::right, FemurLandmarks{medial, lateral}));
  expect_same(frame_from_landmarks(Side::right, TransepicondylarAxis{at(medial), at(lateral), at(centre)}),
              frame_from_landmarks(Side::right, TransepicondylarAxis{medial, lateral, centre}));
}

TEST(JointFrame, TheAnteriorPelvicPlaneHoldsItsThreePoints) {
  const AnteriorPelvicPlane plane{{10, 5, 120}, {12, 3, -115}, {25, -90, 4}};
  const Pose X = frame_from_landmarks(Vec3::Zero(), plane);
  const double at = X.linear().col(0).dot(plane.right_asis);
  // Points of order 100 mm: rounding of a dot product of them.
  EXPECT_NEAR(X.linear().col(0).dot(plane.left_asis), at, 200 * orthonormal_tolerance);
  EXPECT_NEAR(X.linear().col(0).dot(plane.pubic_symphysis), at, 200 * orthonormal_tolerance);
  EXPECT_GT(X.linear()(0, 0), 0.9);
  EXPECT_GT(X.linear()(1, 1), 0.9);
}

TEST(JointFrame, BothFemursPointTheirZToTheRight) {
  const Vec3 inner(0, -400, -40), outer(0, -400, 40);
  const Pose right = frame_from_landmarks(Vec3::Zero(), Side::right, FemurLandmarks{inner, outer});
  const Pose left = frame_from_landmarks(Vec3::Zero(), Side::left, FemurLandmarks{outer, inner});
  EXPECT_TRUE(right.linear().isApprox(Eigen::Matrix3d::Identity(), orthonormal_tolerance));
  EXPECT_TRUE(left.linear().isApprox(Eigen::Matrix3d::Identity(), orthonormal_tolerance));
}

TEST(JointFrame, AFemursYPassesThroughTheHipCentreAKneesZThroughTheEpicondyles) {
  const Vec3 hip(12, 3, -20), medial(5, -400, -40), lateral(-3, -398, 45), middle = (medial + lateral) / 2;
  const Pose femur = frame_from_landmarks(hip, Side::right, FemurLandmarks{medial, lateral});
  EXPECT_LE(femur.linear().col(1).cross((hip - middle).normalized()).norm(), orthonormal_tolerance);
  EXPECT_TRUE(femur.translation() == hip);
  const Pose knee = frame_from_landmarks(Side::right, TransepicondylarAxis{medial, lateral, hip});
  EXPECT_LE(knee.linear().col(2).cross((lateral - medial).normalized()).norm(), orthonormal_tolerance);
  EXPECT_TRUE(knee.translation() == middle);
}

TEST(JointFrame, LandmarksThatCoincideOrLieOnOneLineAreRefused) {
  PelvisLandmarks same = upright_pelvis;
  same.left_asis = same.right_asis;
  EXPECT_THROW(frame_from_landmarks(Vec3::Zero(), same), UsageError);
  const AnteriorPelvicPlane line{{0, 0, 100}, {0, 0, -100}, {0, 0, -300}};
  EXPECT_THROW(frame_from_landmarks(Vec3::Zero(), line), UsageError);
  EXPECT_THROW(frame_from_landmarks(Vec3::Zero(), Side::right, FemurLandmarks{{0, -400, 0}, {0, -300, 0}}),
               UsageError);
}

}  // namespace
}  // namespace condyle
