#include "kinematics/head_shape.hpp"

#include "support/test.hpp"

/// The ellipsoid through a head.

namespace condyle::kinematics {
namespace {

const Sphere about_origin{Vec3::Zero(), 24};

/// A ball that a linear map deforms, moved by a millimetre.
TriMesh ball(const Eigen::Matrix3d& by) {
  return test::mapped(test::sphere(Vec3::Zero(), 24, 4),
                      [&](const Vec3& p) { return Vec3(by * p + Vec3(1, 0, 0)); });
}

TEST(HeadShape, IsThatOfAnEllipsoid) {
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  const auto shape =
      head_shape(ball(turn * Vec3(1.1, 1, 1.05).asDiagonal() * turn.transpose()), about_origin);
  ASSERT_TRUE(shape);
  EXPECT_NEAR((shape->axes - Vec3(1, 1.05, 1.1)).norm(), 0, 1e-9);
  EXPECT_NEAR(std::abs(shape->directions.col(2).dot(turn.col(0))), 1, 1e-9);
  EXPECT_NEAR(std::abs(shape->directions.col(0).dot(turn.col(1))), 1, 1e-9);
}

/// The shear [[1, 0], [t, 1]] has the singular values (sqrt(t^2 + 4) +- t) / 2.
TEST(HeadShape, OfAShearedBallHasTheSingularValuesOfTheShear) {
  for (const double tilt : {0.05, 0.1, 0.17}) {
    Eigen::Matrix3d shear = Eigen::Matrix3d::Identity();
    shear(1, 0) = std::tan(tilt);
    const auto shape = head_shape(ball(shear), about_origin);
    ASSERT_TRUE(shape);
    const double t = std::tan(tilt), ratio = (std::sqrt(t * t + 4) + t) / (std::sqrt(t * t + 4) - t);
    EXPECT_NEAR(shape->axes[2], ratio, 1e-9);
  }
}

TEST(HeadShape, LeavesOutWhatIsNotOfTheHead) {
  // A cam: a ball of half the radius that stands 2 mm out; a neck; the inner wall of a shell.
  const TriMesh head = ball(Eigen::Matrix3d::Identity());
  for (const TriMesh& more : {test::sphere({15, 0, 0}, 12, 4), test::box({-8, -150, -8}, {8, -5, 8}),
                              test::flipped(test::mapped(head, [](const Vec3& p) {
                                return Vec3(0.93 * p.x(), 0.9 * p.y(), 0.95 * p.z());
                              }))}) {
    const auto shape = head_shape(test::joined(head, more), about_origin);
    ASSERT_TRUE(shape);
    EXPECT_LT(shape->axes[2], 1.01);
  }
}

/// Longest over shortest axis of a real femur's head after a linear map.
double longest_of(const TriMesh& femur, const Eigen::Matrix3d& by) {
  const TriMesh mesh = test::turned(femur, by);
  const auto shape = head_shape(mesh, find_sphere(mesh).fit.sphere);
  return shape ? shape->axes[2] : 0;
}

/// The figures of docs/mathematics/09-label-maps.md.
TEST(HeadShape, OfTwoRealHeadsTellsAWrongGrid) {
  if (!test::shared_data()) GTEST_SKIP() << "no shared data: set CONDYLE_DATA";
  for (const auto& [name, as_it_is] : {std::pair{"hip_vhf_right", 1.03}, {"hip_libhip_m1_left", 1.07}}) {
    const TriMesh femur = test::read_ply(*test::shared_data() / name / "femur.ply");
    EXPECT_NEAR(longest_of(femur, Eigen::Matrix3d::Identity()), as_it_is, 0.005) << name;
    for (int axis = 0; axis < 3; ++axis) {
      for (const double factor : {0.9, 1.1}) {
        Eigen::Matrix3d stretched = Eigen::Matrix3d::Identity();
        stretched(axis, axis) = factor;
        const double longest = longest_of(femur, stretched);
        EXPECT_GT(longest, 1.095) << name << ", axis " << axis << " by " << factor << ": " << longest;
        EXPECT_LT(longest, 1.17) << name << ", axis " << axis << " by " << factor << ": " << longest;
      }
      for (const int along : {(axis + 1) % 3, (axis + 2) % 3}) {
        Eigen::Matrix3d sheared = Eigen::Matrix3d::Identity();
        sheared(along, axis) = std::tan(10 * std::numbers::pi / 180);
        const double longest = longest_of(femur, sheared);
        EXPECT_GT(longest, 1.13) << name << ", " << along << " along " << axis << ": " << longest;
        EXPECT_LT(longest, 1.27) << name << ", " << along << " along " << axis << ": " << longest;
      }
    }
  }
}

TEST(HeadShape, NeedsPointsOfAHead) {
  EXPECT_FALSE(head_shape(test::box({-20, -20, -20}, {20, 20, 20}), about_origin));
  EXPECT_FALSE(head_shape(test::sphere(Vec3::Zero(), 24, 1), about_origin)) << "18 points";
}

}  // namespace
}  // namespace condyle::kinematics
