#include "tangential/build/free_directions.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace condyle::tangential {
namespace {

using Directions = FreeDirections::Directions;

/// By the sectors of a triangle's corners; one more bit than there are directions where they do not tell.
constexpr std::uint16_t untold = 0x100;
constexpr std::array<std::uint16_t, 256> directions_between = [] {
  std::array<std::uint16_t, 256> table{};
  table.fill(untold);
  // From the widest angle to the narrowest: `width` sectors from sector `first` on.
  for (unsigned width = 4; width > 0; --width) {
    for (unsigned first = 0; first < 8; ++first) {
      unsigned sectors = 0, directions = 0;
      for (unsigned k = 0; k < width; ++k) sectors |= 1u << (first + k) % 8;
      for (unsigned k = 1; k < width; ++k) directions |= 1u << (first + k) % 8;
      for (unsigned within = 1; within < 256; ++within)
        if ((within & ~sectors) == 0) table[within] = static_cast<std::uint16_t>(directions);
    }
  }
  return table;
}();

/// The connected patches of cells that are free in one direction.
class Patches {
 public:
  Patches(const ProfileGrid& grid, const std::vector<Directions>& taken, int direction)
      : patch_of_(grid.cells(), no_index) {
    const auto is_free = [&](std::size_t cell) { return (taken[cell] >> direction & 1) == 0; };
    for (Index row = 0; row < grid.rows; ++row) {
      const bool outermost_row = row == 0 || row + 1 == grid.rows;
      Index left = no_index;
      for (Index column = 0; column < grid.columns; ++column) {
        const std::size_t cell = grid.cell(row, column);
        if (!is_free(cell)) {
          left = no_index;
          continue;
        }
        const Index below = row > 0 ? patch_of_[cell - grid.columns] : no_index;
        if (left == no_index) {
          left = below != no_index ? below : begin_patch(cell);
        } else if (below != no_index && below != left) {
          unite(left, below);
        }
        patch_of_[cell] = left;
        // Beside the axis, where column 0 begins at radius 0, is no border.
        const bool outermost_column = (column == 0 && grid.rho_min > 0) || column + 1 == grid.columns;
        if (outermost_row || outermost_column) at_border_[root(left)] = true;
      }
    }
  }

  /// visit(root, first_cell, at_border) for each patch.
  template <class Visit>
  void for_each(const Visit& visit) const {
    for (Index patch = 0; patch < parent_.size(); ++patch) {
      if (parent_[patch] == patch) visit(patch, first_cell_[patch], at_border_[patch]);
    }
  }

  /// The patch of a cell, by its root; none where the direction is taken.
  Index of(std::size_t cell) const noexcept {
    return patch_of_[cell] == no_index ? no_index : root(patch_of_[cell]);
  }
  std::size_t size() const noexcept { return parent_.size(); }

 private:
  Index begin_patch(std::size_t cell) {
    parent_.push_back(static_cast<Index>(parent_.size()));
    first_cell_.push_back(cell);
    at_border_.push_back(false);
    return parent_.back();
  }
  Index root(Index patch) const noexcept {
    while (parent_[patch] != patch) patch = parent_[patch];
    return patch;
  }
  void unite(Index a, Index b) noexcept {
    const auto [low, high] = std::minmax({root(a), root(b)});
    parent_[high] = low;
    at_border_[low] = at_border_[low] || at_border_[high];
    // Short ways to the root for whoever asks next.
    parent_[a] = parent_[b] = low;
  }

  std::vector<Index> patch_of_, parent_;
  std::vector<std::size_t> first_cell_;
  std::vector<bool> at_border_;
};

}  // namespace

/// With s the distance from the line of a direction and its opposite, signed, and c how far along it: all
/// corners beyond `apart` on one side, which is clearance times the largest radius, keep every point of the
/// triangle that far away in angle; all corners behind the axis keep it a quarter turn away.
Directions FreeDirections::near(const Vec3& a, const Vec3& b, const Vec3& c) noexcept {
  const auto rho2 = [](const Vec3& p) { return p.x() * p.x() + p.y() * p.y(); };
  // Along diagonals s and c are the square root of 2 too large; 3/2 covers that and all rounding.
  const double apart = 1.5 * clearance * std::sqrt(std::max({rho2(a), rho2(b), rho2(c)}));
  // From one corner to another s and c change by no more than |dx| + |dy|: most triangles are between two
  // directions with all they have.
  const auto way = [](const Vec3& p, const Vec3& q) {
    return std::abs(q.x() - p.x()) + std::abs(q.y() - p.y());
  };
  const double nearest = std::min(std::min(std::abs(a.x()), std::abs(a.y())),
                                  std::min(std::abs(a.x() - a.y()), std::abs(a.x() + a.y())));
  if (nearest > 1.01 * std::max(way(a, b), way(a, c)) + apart) return 0;
  unsigned directions = 0;
  const auto look = [&](int direction, const auto& s, const auto& along) {
    const std::array<double, 3> side = {s(a), s(b), s(c)};
    const auto [low, high] = std::minmax({side[0], side[1], side[2]});
    if (low > apart || high < -apart) return;
    const std::array<double, 3> on = {along(a), along(b), along(c)};
    if (std::max({on[0], on[1], on[2]}) >= -apart) directions |= 1u << direction;
    if (std::min({on[0], on[1], on[2]}) <= apart) directions |= 1u << (direction + count / 2);
  };
  look(
      0, [](const Vec3& p) { return p.y(); }, [](const Vec3& p) { return p.x(); });
  look(
      1, [](const Vec3& p) { return p.y() - p.x(); }, [](const Vec3& p) { return p.x() + p.y(); });
  look(
      2, [](const Vec3& p) { return -p.x(); }, [](const Vec3& p) { return p.y(); });
  look(
      3, [](const Vec3& p) { return -p.x() - p.y(); }, [](const Vec3& p) { return p.y() - p.x(); });
  return static_cast<Directions>(directions);
}

std::optional<FreeDirections::Directions> FreeDirections::between(Sectors sectors) noexcept {
  const std::uint16_t directions = directions_between[sectors];
  if (directions == untold) return std::nullopt;
  return static_cast<Directions>(directions);
}

FreeDirections::FreeDirections(const ProfileGrid& grid, const std::vector<Directions>& taken,
                               const WindingAt& winding_at, std::size_t cells_per_winding)
    : anchor_(grid.cells()) {
  constexpr int unknown = std::numeric_limits<std::int8_t>::max() + 1;
  const auto winding_in_middle = [&](int direction, std::size_t cell) {
    const auto row = static_cast<Index>(cell / grid.columns),
               column = static_cast<Index>(cell % grid.columns);
    const double rho = grid.rho_min + (column + 0.5) * grid.rho_cell;
    const double z = grid.z_min + (row + 0.5) * grid.z_cell;
    // In cells as narrow as rounding the middle may fall beside.
    const int winding = grid.cell_of(rho, z) == cell ? winding_at(direction, rho, z) : unknown;
    return std::abs(winding) < unknown ? winding : unknown;
  };
  std::size_t open = grid.cells();
  const auto set = [&](std::size_t cell, int direction, int winding) {
    if (anchor_[cell].direction != none || winding == unknown) return;
    anchor_[cell] = {static_cast<std::int8_t>(direction), static_cast<std::int8_t>(winding)};
    --open;
  };
  // A direction costs a walk over all cells, and one or two leave next to nothing to do: where that is less
  // than a walk, each cell is asked about by itself.
  int direction = 0;
  for (; direction < count && open * cells_per_winding >= grid.cells(); ++direction) {
    const Patches patches(grid, taken, direction);
    std::vector<int> winding(patches.size(), 0);
    patches.for_each([&](Index patch, std::size_t cell, bool at_border) {
      if (!at_border) winding[patch] = winding_in_middle(direction, cell);
    });
    for (std::size_t cell = 0; cell < anchor_.size(); ++cell) {
      if (const Index patch = patches.of(cell); patch != no_index) set(cell, direction, winding[patch]);
    }
  }
  for (std::size_t cell = 0; cell < anchor_.size() && open > 0 && direction < count; ++cell) {
    for (int k = direction; k < count && anchor_[cell].direction == none; ++k) {
      if ((taken[cell] >> k & 1) == 0) set(cell, k, winding_in_middle(k, cell));
    }
  }
}

}  // namespace condyle::tangential
