#pragma once

#include <cmath>
#include <cstddef>
#include <optional>

#include "condyle/pose.hpp"

namespace condyle::tangential {

/// Distance from the z axis. Two rounded products, a sum and a root: off by at most 3u of itself.
inline double axis_radius(double x, double y) noexcept {
  return std::sqrt(x * x + y * y);
}

/// Rectangular cells over the profile half-plane (rho, z) of an axis on z. Rotated about the axis, a cell is a
/// ring.
///
///     z
///     |      +---+---+---+---+  z_max
///     |      |   |   |   |   |       row r, column c  ->  cell r * columns + c
///   axis     +---+---+---+---+
///     |      |   |   |   |   |  row 0
///     |      +---+---+---+---+  z_min
///     |      ^ column 0      ^
///     +--- rho_min -------- rho_max ------- rho
///
/// `row_at` and `column_at` never decrease as their argument grows, rounding included: a point between two
/// others falls in a row between theirs.
struct ProfileGrid {
  double rho_min = 0, rho_max = 0, z_min = 0, z_max = 0;
  double rho_cell = 1, z_cell = 1;
  double columns_per_mm = 1, rows_per_mm = 1;
  Index columns = 1, rows = 1;

  /// Radii and heights from the least to the greatest, in mm.
  struct Extent {
    double rho_min, rho_max, z_min, z_max;
  };
  /// Cells of one size, about square and about `cells` in number, over all of these.
  static ProfileGrid over(const Extent& extent, std::size_t cells);

  std::size_t cells() const noexcept { return static_cast<std::size_t>(columns) * rows; }

  /// Row and column of a height and a radius, the outermost ones for everything beyond the grid.
  Index row_at(double z) const noexcept { return clamped((z - z_min) * rows_per_mm, rows); }
  Index column_at(double rho) const noexcept { return clamped((rho - rho_min) * columns_per_mm, columns); }

  std::size_t cell(Index row, Index column) const noexcept {
    return static_cast<std::size_t>(row) * columns + column;
  }

  /// Cell of a circle; none if it lies beyond the grid.
  std::optional<std::size_t> cell_of(double rho, double z) const noexcept {
    if (!(rho >= rho_min && rho <= rho_max && z >= z_min && z <= z_max)) return std::nullopt;
    return cell(row_at(z), column_at(rho));
  }

 private:
  static Index clamped(double steps, Index count) noexcept {
    return steps <= 0 ? 0 : steps >= count ? count - 1 : static_cast<Index>(steps);
  }
};

}  // namespace condyle::tangential
