#include "core/symmetric.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

namespace condyle::core {

SymmetricAxes axes_of(const Eigen::Matrix3d& symmetric) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(symmetric);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

Vec3 solved(const Eigen::Matrix3d& A, const Vec3& b) {
  return A.ldlt().solve(b);
}

Vec3 shortest_solved(const Eigen::Matrix3d& A, const Vec3& b) {
  // Where all arms lie in one line, a sum of some 90 products rounds to less than this share of the largest eigenvalue.
  constexpr double rounding = 1e-14;
  const auto [values, directions] = axes_of(A);
  Vec3 x = Vec3::Zero();
  for (int i = 0; i < 3; ++i)
    if (values[i] > rounding * values[2]) x += directions.col(i).dot(b) / values[i] * directions.col(i);
  return x;
}

}  // namespace condyle::core
