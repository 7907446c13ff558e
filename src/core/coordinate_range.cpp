#include "core/coordinate_range.hpp"

#include <cmath>
#include <string>

#include "condyle/error.hpp"

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

}  // namespace condyle::core
