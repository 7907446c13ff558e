#include "io/joint/pose_matrix.hpp"

#include <fmt/format.h>

#include "condyle/error.hpp"
#include "io/joint/nearest_rotation.hpp"

namespace condyle::io {
namespace {

/// Off by no more than this it is a rotation as doubles have it, and kept bit for bit.
constexpr double rounding_skew = 4e-15;

}  // namespace

PoseOfRows pose_of_rows(const std::array<double, 16>& rows) {
  Pose X = Pose::Identity();
  for (int i = 0; i < 16; ++i) X.matrix()(i / 4, i % 4) = rows[static_cast<std::size_t>(i)] + 0.0;
  if (X.matrix().row(3) != Eigen::RowVector4d(0, 0, 0, 1)) {
    const bool transposed = X.matrix().col(3) == Eigen::Vector4d(0, 0, 0, 1);
    throw UsageError(fmt::format("the last row of the matrix must be 0 0 0 1, not {} {} {} {}{}", rows[12],
                                 rows[13], rows[14], rows[15], transposed ? ": it looks transposed" : ""));
  }
  const Eigen::Matrix3d R = X.linear();
  const double skew = orthonormality_error(R);
  if (!(skew <= largest_skew))
    throw UsageError(fmt::format(
        "the rotation of the matrix is not orthonormal: off by {:.2g}, more than {:g}", skew, largest_skew));
  if (R.determinant() < 0) throw UsageError("the matrix mirrors: its determinant is -1");
  if (skew <= rounding_skew) return {X, 0};
  X.linear() = nearest_rotation(R);
  return {X, skew};
}

}  // namespace condyle::io
