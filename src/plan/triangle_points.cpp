#include "plan/triangle_points.hpp"

#include <algorithm>
#include <cmath>

namespace condyle::plan {

std::vector<Vec3> points_of_triangle(const std::array<Vec3, 3>& corners, double spacing_mm) {
  const auto side = [&](std::size_t k) { return Vec3(corners[(k + 1) % 3] - corners[k]); };
  std::size_t longest = 0;
  for (std::size_t k = 1; k < 3; ++k)
    if (side(k).squaredNorm() > side(longest).squaredNorm()) longest = k;
  const Vec3 &from = corners[longest], &to = corners[(longest + 1) % 3], &apex = corners[(longest + 2) % 3];
  const double length = side(longest).norm(),
               height = length > 0 ? side(longest).cross(apex - from).norm() / length : 0;
  const auto parts = [&](double over) { return std::max(1, static_cast<int>(std::ceil(over / spacing_mm))); };
  std::vector<Vec3> points{apex};
  const int rows = parts(height);
  for (int row = 1; row <= rows; ++row) {
    const double down = static_cast<double>(row) / rows;
    const int columns = parts(down * length);
    for (int column = 0; column <= columns; ++column)
      points.push_back(apex + down * (from + (to - from) * (static_cast<double>(column) / columns) - apex));
  }
  return points;
}

}  // namespace condyle::plan
