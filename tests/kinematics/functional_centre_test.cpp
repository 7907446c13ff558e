#include "kinematics/functional_centre.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "condyle/error.hpp"
#include "core/rotation_about.hpp"

namespace condyle::kinematics {
namespace {

using testing::HasSubstr;

constexpr double per_degree = std::numbers::pi / 180;

/// Poses of a mobile body that turns about in_fixed, where its in_mobile lies.
class Recording {
 public:
  explicit Recording(unsigned seed) : random_(seed) {}

  double normal() { return normal_(random_); }
  Vec3 normals(double sd) { return sd * Vec3(normal(), normal(), normal()); }

  /// Rotation vectors with these standard deviations about x, y and z, degrees.
  std::vector<Pose> poses(std::size_t count, const Vec3& degrees) {
    std::vector<Pose> all;
    for (std::size_t i = 0; i < count; ++i) {
      Pose X =
          core::moved_by(Pose::Identity(), Vec3::Zero(), per_degree * Vec3(degrees.cwiseProduct(normals(1))));
      X.translation() = in_fixed - X.linear() * in_mobile;
      all.push_back(X);
    }
    return all;
  }
  /// Noise of positions, mm, and of rotations, rad.
  std::vector<Pose> noisy(std::vector<Pose> poses, double mm, double rad = 0) {
    for (Pose& X : poses) {
      X.translation() += normals(mm);
      const Vec3 by = normals(rad);
      if (by.norm() > 0) X.linear() = core::rotation_about(by.normalized(), by.norm()) * X.linear();
    }
    return poses;
  }

  Vec3 in_fixed{12, -7, 81}, in_mobile{-3, 402, 25};

 private:
  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;
};

/// I - R'R of the mean rotation R.
Eigen::Matrix3d spread_of(const std::vector<Pose>& poses) {
  Eigen::Matrix3d mean = Eigen::Matrix3d::Zero();
  for (const Pose& X : poses) mean += X.linear() / static_cast<double>(poses.size());
  return Eigen::Matrix3d::Identity() - mean.transpose() * mean;
}

std::string refusal(const std::vector<Pose>& poses, bool axis = false) {
  try {
    if (axis)
      (void)functional_axis(poses);
    else
      (void)functional_centre(poses);
  } catch (const MeshError& error) {
    return error.what();
  }
  return "none";
}

TEST(FunctionalCentre, IsExactWithoutNoise) {
  Recording recording(1);
  for (const Vec3& degrees : {Vec3(20, 12, 15), Vec3(5, 6, 30), Vec3(60, 40, 40)}) {
    const auto found = functional_centre(recording.poses(200, degrees));
    EXPECT_LT((found.in_fixed - recording.in_fixed).norm(), 1e-9);
    EXPECT_LT((found.in_mobile - recording.in_mobile).norm(), 1e-9);
    EXPECT_LT(found.residual_mm, 1e-9);
    EXPECT_LT(found.centre_bound_mm, 1e-9);
  }
}

TEST(FunctionalCentre, DoesNotDependOnTheFrames) {
  Recording recording(2);
  std::vector<Pose> poses = recording.noisy(recording.poses(100, {20, 12, 15}), 1);
  const auto found = functional_centre(poses);
  const Pose before = core::moved_by(Pose::Identity(), {300, -20, 4}, {0.3, -1, 0.4}),
             after = core::moved_by(Pose::Identity(), {-5, 88, 700}, {-0.7, 0.2, 0.9});
  for (Pose& X : poses) X = before * X * after;
  const auto moved = functional_centre(poses);
  EXPECT_LT((moved.in_fixed - before * found.in_fixed).norm(), 1e-9);
  EXPECT_LT((moved.in_mobile - inverted(after) * found.in_mobile).norm(), 1e-9);
  EXPECT_NEAR(moved.residual_mm, found.residual_mm, 1e-9);
  EXPECT_NEAR(moved.centre_bound_mm, found.centre_bound_mm, 1e-9);
}

/// Independent errors of positions, s in each coordinate, give no bias and, in the fixed body, the covariance s^2 / n (I + R A^-1 R').
TEST(FunctionalCentre, HasTheSpreadOfLeastSquaresAndNoBias) {
  constexpr int runs = 1000;
  for (const double noise_mm : {0.1, 1.0}) {
    Recording recording(3);
    const std::vector<Pose> poses = recording.poses(200, {20, 7, 9});
    Eigen::Matrix3d mean_rotation = Eigen::Matrix3d::Zero();
    for (const Pose& X : poses) mean_rotation += X.linear() / 200;
    const Eigen::Matrix3d covariance =
        noise_mm * noise_mm / 200 *
        (Eigen::Matrix3d::Identity() +
         mean_rotation * spread_of(poses).inverse() * mean_rotation.transpose());
    Vec3 sum = Vec3::Zero(), squares = Vec3::Zero();
    double sd = 0;
    int held = 0;
    for (int i = 0; i < runs; ++i) {
      const auto found = functional_centre(recording.noisy(poses, noise_mm));
      const Vec3 off = found.in_fixed - recording.in_fixed;
      sum += off, squares += off.cwiseAbs2();
      held += off.norm() <= found.centre_bound_mm;
      sd += found.sd_mm / runs;
    }
    for (int k = 0; k < 3; ++k) {
      const double theory = std::sqrt(covariance(k, k));
      EXPECT_NEAR(std::sqrt(squares[k] / runs), theory, 0.08 * theory);
      EXPECT_LT(std::abs(sum[k] / runs), 0.1 * theory);
    }
    EXPECT_NEAR(sd, std::sqrt(covariance.trace() / 3), 0.1 * sd);
    EXPECT_GE(held, 0.9 * runs);
    EXPECT_LE(held, 0.99 * runs);
  }
}

/// Errors of rotations, e in each coordinate, draw the mobile body's point c towards the origin of its frame by 2 e^2 A^-1 c, nearly.
TEST(FunctionalCentre, HasTheBiasOfErrorsInRotations) {
  constexpr int runs = 400;
  constexpr double noise_rad = 0.01;
  Recording recording(4);
  recording.in_mobile = {20, 90, -40};
  const std::vector<Pose> poses = recording.poses(200, {14, 10, 12});
  Vec3 off = Vec3::Zero();
  for (int i = 0; i < runs; ++i)
    off += (functional_centre(recording.noisy(poses, 0, noise_rad)).in_mobile - recording.in_mobile) / runs;
  const Vec3 theory = -2 * noise_rad * noise_rad * (spread_of(poses).inverse() * recording.in_mobile);
  EXPECT_GT(theory.norm(), 0.2);
  EXPECT_LT((off - theory).norm(), 0.15 * theory.norm());
}

/// Skin that slides as the joint turns moves the centre and leaves no residual.
TEST(FunctionalCentre, DoesNotSeeWhatMovesWithTheJoint) {
  Recording recording(5);
  std::vector<Pose> poses = recording.poses(200, {20, 12, 15});
  const Vec3 slid(4, -6, 9);
  // As far as angles are small: R c + d(angles), d linear in them, is the rotation of another point.
  for (Pose& X : poses) X.translation() += X.linear() * slid - slid;
  const auto found = functional_centre(poses);
  EXPECT_LT((found.in_fixed - (recording.in_fixed - slid)).norm(), 1e-9);
  EXPECT_LT(found.centre_bound_mm, 1e-9);
}

TEST(FunctionalCentre, SaysByHowMuchAMotionIsTooPlanarOrTooSmall) {
  Recording recording(6);
  EXPECT_THAT(refusal(recording.poses(200, {30, 0, 0})), HasSubstr(" and by 0.0 off it"));
  EXPECT_THAT(refusal(recording.poses(400, {30, 2, 2})),
              AllOf(HasSubstr("about one axis and by 2."), HasSubstr("a centre needs 5.0 off it")));
  EXPECT_THAT(refusal(recording.poses(200, {1, 1, 1})), HasSubstr("a centre needs 5.0 off it"));
  EXPECT_THAT(refusal(recording.poses(19, {20, 12, 15})), HasSubstr("there are 19, and 20 are needed"));
  EXPECT_EQ(refusal(recording.poses(20, {20, 12, 15})), "none");
}

TEST(FunctionalAxis, IsExactWithoutNoise) {
  Recording recording(7);
  std::vector<Pose> poses = recording.poses(100, {0, 0, 25});
  const auto found = functional_axis(poses);
  EXPECT_LT((found.in_fixed.direction - Vec3::UnitZ()).norm(), 1e-9);
  EXPECT_LT((found.in_mobile.direction - Vec3::UnitZ()).norm(), 1e-9);
  const auto beside = [](const Vec3& v) { return std::hypot(v.x(), v.y()); };
  EXPECT_LT(beside(found.in_fixed.point - recording.in_fixed), 1e-9);
  EXPECT_LT(beside(found.in_mobile.point - recording.in_mobile), 1e-9);
  EXPECT_NEAR(found.in_mobile.point.z(), 0, 1e-9);
  EXPECT_LT(found.residual_mm, 1e-9);
  EXPECT_LT(found.axis_bound_mm, 1e-9);
  EXPECT_LT(found.direction_bound.degrees(), 1e-6);
}

TEST(FunctionalAxis, IsFoundBesideSomeOtherTurning) {
  Recording recording(8);
  int held = 0, beside = 0;
  for (int i = 0; i < 100; ++i) {
    const auto found = functional_axis(recording.noisy(recording.poses(300, {2, 1, 25}), 0.3));
    const double off = std::acos(std::min(1.0, found.in_fixed.direction.z())) / per_degree;
    held += off <= found.direction_bound.degrees();
    EXPECT_LT(off, 1);
    const Vec3 from = recording.in_fixed - found.in_fixed.point;
    beside +=
        (from - from.dot(found.in_fixed.direction) * found.in_fixed.direction).norm() <= found.axis_bound_mm;
  }
  EXPECT_GE(held, 85);
  EXPECT_GE(beside, 85);
}

TEST(FunctionalAxis, IsRefusedWhereThereIsNone) {
  Recording recording(9);
  EXPECT_THAT(refusal(recording.poses(200, {20, 20, 20}), true), HasSubstr("they have no one axis"));
  EXPECT_THAT(refusal(recording.poses(400, {0, 0, 3}), true),
              AllOf(HasSubstr("about its main axis"), HasSubstr("5.0 are needed")));
}

}  // namespace
}  // namespace condyle::kinematics
