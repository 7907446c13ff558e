#include "core/symmetric.hpp"

#include "support/test.hpp"

/// Symmetric matrices of known axes.

namespace condyle::core {
namespace {

const Eigen::Matrix3d axes = Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix();

Eigen::Matrix3d with(const Vec3& values) {
  return axes * values.asDiagonal() * axes.transpose();
}

TEST(Symmetric, HasItsAxesInTheOrderOfTheirValues) {
  const auto [values, directions] = axes_of(with({5, -2, 3}));
  EXPECT_LT((values - Vec3(-2, 3, 5)).norm(), 1e-14);
  for (const auto& [column, of] : {std::pair{0, 1}, {1, 2}, {2, 0}})
    EXPECT_NEAR(std::abs(directions.col(column).dot(axes.col(of))), 1, 1e-14);
}

TEST(Symmetric, IsSolvedFromItsLowerHalf) {
  Eigen::Matrix3d A = with({5, 1, 3});
  const Vec3 x(0.3, -2, 7), b = A * x;
  A.triangularView<Eigen::StrictlyUpper>().setConstant(99);
  EXPECT_LT((solved(A, b) - x).norm(), 1e-13);
  EXPECT_LT((shortest_solved(A, b) - x).norm(), 1e-13);
}

TEST(Symmetric, WithoutADirectionHasTheShortestSolution) {
  const Vec3 x = axes * Vec3(2, 0, -3);
  const Vec3 also = 40 * axes.col(1);  // A takes it to nothing, and nothing of A reaches it
  EXPECT_LT((shortest_solved(with({5, 0, 1}), with({5, 0, 1}) * (x + also) + also) - x).norm(), 1e-12);
  EXPECT_EQ(shortest_solved(Eigen::Matrix3d::Zero(), x), Vec3::Zero());
}

}  // namespace
}  // namespace condyle::core
