#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "condyle/tangential/profile.hpp"
#include "condyle/tangential/profile_boxes.hpp"

namespace condyle {

/// Sides of boxes in 256ths of a cell, from the grid's corner, rounded outwards and kept within the grid: the
/// cell in the upper bits, the byte in it in the lower eight.
struct BoxSides {
  std::int32_t rho_low, rho_high, z_low, z_high;

  Index first_column() const noexcept { return static_cast<Index>(rho_low) >> 8; }
  Index last_column() const noexcept { return static_cast<Index>(rho_high) >> 8; }
  Index first_row() const noexcept { return static_cast<Index>(z_low) >> 8; }
  Index last_row() const noexcept { return static_cast<Index>(z_high) >> 8; }
};

/// Some boxes side by side.
struct BoxSidesBatch {
  static constexpr std::size_t most = 256;
  alignas(64) std::array<std::int32_t, most> rho_low, rho_high, z_low, z_high;

  BoxSides operator[](std::size_t i) const noexcept { return {rho_low[i], rho_high[i], z_low[i], z_high[i]}; }
};

/// From units of the boxes to 256ths of cells.
class BoxScale {
 public:
  BoxScale(const ProfileGrid& grid, double units_per_mm) noexcept;

  /// The boxes [first, first + count), count at most a batch.
  void sides(const ProfileBoxes& boxes, std::size_t first, std::size_t count, BoxSidesBatch& out) const;
  BoxSides sides(const ProfileBoxes& boxes, std::size_t triangle) const;

  struct Axis {
    float origin, per_unit, slack, last;
  };

 private:
  Axis rho_, z_;
};

}  // namespace condyle
