#include "core/coordinate_range.hpp"

#include <cmath>
#include <string>

#include "condyle/error.hpp"
#include "core/formatted.hpp"

namespace condyle::core {

std::optional<std::size_t> first_out_of_range(PointsView points) noexcept {
  for (std::size_t i = 0; i < points.size(); ++i) {
    // Not a number is in no range.
    if (!(std::abs(points.x[i]) <= largest_coordinate && std::abs(points.y[i]) <= largest_coordinate &&
          std::abs(points.z[i]) <= largest_coordinate))
      return i;
  }
  return std::nullopt;
}

void require_in_range(PointsView points) {
  if (const auto i = first_out_of_range(points))
    throw UsageError("point " + std::to_string(*i) +
                     " has a coordinate that is not finite or beyond 1e30 mm");
}

void require_in_range(const Pose& X_FM) {
  // One sum of zeros, or one NaN.
  if (!std::isfinite((X_FM.matrix() * 0).sum())) throw UsageError("pose: an entry is not finite");
  if (X_FM.translation().cwiseAbs().maxCoeff() > largest_coordinate)
    throw UsageError("pose: its translation is beyond 1e30 mm");
}

void require_rotation(const Pose& X_FM) {
  require_in_range(X_FM);
  const Eigen::Matrix3d R = X_FM.linear();
  const double skew = (R.transpose() * R - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  if (skew > largest_skew)
    throw UsageError(
        formatted("pose: its matrix is no rotation: off by %.2g, more than %g", skew, largest_skew));
  if (Vec3(R.col(0)).cross(Vec3(R.col(1))).dot(R.col(2)) < 0)
    throw UsageError("pose: its matrix mirrors: the determinant is -1");
}

}  // namespace condyle::core
