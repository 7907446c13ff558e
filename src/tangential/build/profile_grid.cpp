#include "tangential/build/profile_grid.hpp"

#include <algorithm>

namespace condyle::tangential {

ProfileGrid ProfileGrid::over(const Extent& extent, std::size_t cells) {
  // 256ths of cells are counted in floats, exactly.
  constexpr double most_per_side = 0x1p15;
  ProfileGrid grid;
  grid.rho_min = extent.rho_min, grid.rho_max = extent.rho_max;
  grid.z_min = extent.z_min, grid.z_max = extent.z_max;
  const double width = grid.rho_max - grid.rho_min, height = grid.z_max - grid.z_min;
  const double target = static_cast<double>(std::max<std::size_t>(cells, 1));
  // Square cells of side s with width/s * height/s = target; a thin profile keeps one cell across.
  const double side =
      std::max({std::sqrt(width) * std::sqrt(height / target), width / target, height / target});
  if (side > 0) {
    const auto count = [&](double length) {
      return static_cast<Index>(std::clamp(std::ceil(length / side), 1.0, std::min(target, most_per_side)));
    };
    grid.columns = count(width), grid.rows = count(height);
  }
  if (width > 0) grid.rho_cell = width / grid.columns, grid.columns_per_mm = 1 / grid.rho_cell;
  if (height > 0) grid.z_cell = height / grid.rows, grid.rows_per_mm = 1 / grid.z_cell;
  return grid;
}

}  // namespace condyle::tangential
