#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "tangential/build/cell_box.hpp"
#include "tangential/build/profile_boxes.hpp"
#include "tangential/build/profile_raster.hpp"

namespace condyle::tangential {

/// Sides of a box in 256ths of a cell, from the grid's corner, rounded outwards and kept within the grid: the
/// cell in the upper bits, the byte in it in the lower eight.
struct BoxSides {
  std::int32_t rho_low, rho_high, z_low, z_high;

  Index first_column() const noexcept { return static_cast<Index>(rho_low) >> 8; }
  Index last_column() const noexcept { return static_cast<Index>(rho_high) >> 8; }
  Index first_row() const noexcept { return static_cast<Index>(z_low) >> 8; }
  Index last_row() const noexcept { return static_cast<Index>(z_high) >> 8; }

  /// The part of the box within a cell that it meets.
  CellBox in_cell(Index row, Index column) const noexcept {
    const auto low = [](std::int32_t side, bool here) {
      return here ? static_cast<CellBox>(side & 0xff) : 0;
    };
    const auto high = [](std::int32_t side, bool here) {
      return here ? static_cast<CellBox>(~side & 0xff) : 0;
    };
    return low(z_low, row == first_row()) | high(z_high, row == last_row()) << 8 |
           low(rho_low, column == first_column()) << 16 | high(rho_high, column == last_column()) << 24;
  }
};

/// Some triangles and the cells that their boxes meet.
struct BoxCells {
  static constexpr std::size_t most = 256;
  /// With padding: vectors are stored whole.
  using Slots = std::array<Index, most + 16>;

  /// For each slot of the batch, which is one triangle, a cell and the box within it.
  struct Corner {
    alignas(64) std::array<Index, most> cell, box;
    Slots in_use;  ///< Slots of the triangles that have this cell, ascending.
    std::size_t count;
  };
  /// For boxes of at most two by two cells: the first, that beside it, that above it, and that above both.
  std::array<Corner, 4> corner;
  Slots large;  ///< Boxes that meet more cells: these have none of the above.
  std::size_t large_count;
};

/// From units of the boxes to cells of the grid.
class BoxScale {
 public:
  BoxScale(const ProfileGrid& grid, double units_per_mm) noexcept;

  /// Cells of the boxes [first, first + count), count at most a batch.
  void cells(const ProfileBoxes& boxes, std::size_t first, std::size_t count, BoxCells& out) const;

  struct Axis {
    float origin, per_unit, slack, last;
  };

  BoxSides sides(const ProfileBoxes& boxes, std::size_t triangle) const noexcept {
    const auto side = [](const Axis& axis, float from, float outwards) {
      const float moved = (from - axis.origin) * axis.per_unit + outwards * axis.slack;
      return static_cast<std::int32_t>(std::min(std::max(moved, 0.0f), axis.last));
    };
    return {.rho_low = side(rho_, boxes.rho_low[triangle], -1),
            .rho_high = side(rho_, boxes.rho_high[triangle], 1),
            .z_low = side(z_, boxes.z_low[triangle], -1),
            .z_high = side(z_, boxes.z_high[triangle], 1)};
  }

 private:
  Axis rho_, z_;
  Index columns_;
};

/// visit(row, column) for the cells in which a triangle is entered: those that its box meets, of a box of many
/// cells those that it meets itself.
template <class Visit>
void for_each_cell(const ProfileGrid& grid, const BoxSides& sides, const Vec3& a, const Vec3& b,
                   const Vec3& c, const Visit& visit) {
  constexpr std::size_t many = 16;
  const Index first = sides.first_column(), last = sides.last_column();
  if (std::size_t{last - first + 1} * (sides.last_row() - sides.first_row() + 1) <= many) {
    for (Index row = sides.first_row(); row <= sides.last_row(); ++row) {
      for (Index column = first; column <= last; ++column) visit(row, column);
    }
    return;
  }
  for_each_profile_run(grid, a, b, c, [&](Index row, Index from, Index to) {
    for (Index column = std::max(from, first); column <= std::min(to, last); ++column) visit(row, column);
  });
}

}  // namespace condyle::tangential
