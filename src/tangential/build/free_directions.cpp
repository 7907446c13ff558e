#include "tangential/build/free_directions.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include "core/trigonometry.hpp"
#include "tangential/build/box_cells.hpp"
#include "tangential/exact/circle_crossing.hpp"

namespace condyle::tangential {
namespace {

using Directions = FreeDirections::Directions;

/// By the sectors of a triangle's corners; one more bit than there are directions where these do not decide.
constexpr std::uint16_t undecided = 0x100;
constexpr std::array<std::uint16_t, 256> directions_between = [] {
  std::array<std::uint16_t, 256> table{};
  table.fill(undecided);
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

  /// The patch of a cell, by its root; none if the direction is taken.
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
    // Short paths to the root for later calls.
    parent_[a] = parent_[b] = low;
  }

  std::vector<Index> patch_of_, parent_;
  std::vector<std::size_t> first_cell_;
  std::vector<bool> at_border_;
};

}  // namespace

/// With s the signed distance from the line of a direction and its opposite, and c the distance along it: all
/// corners beyond `apart` on one side, which is clearance times the largest radius, keep every point of the
/// triangle that far away in angle; all corners behind the axis keep it a quarter turn away.
Directions FreeDirections::near(const Vec3& a, const Vec3& b, const Vec3& c) noexcept {
  const auto rho2 = [](const Vec3& p) { return p.x() * p.x() + p.y() * p.y(); };
  // Along diagonals s and c are the square root of 2 too large; 3/2 covers that and all rounding.
  const double apart = 1.5 * clearance * std::sqrt(std::max({rho2(a), rho2(b), rho2(c)}));
  // From one corner to another s and c change by no more than |dx| + |dy|: most triangles are between two
  // directions with all they have.
  const auto change = [](const Vec3& p, const Vec3& q) {
    return std::abs(q.x() - p.x()) + std::abs(q.y() - p.y());
  };
  const double nearest = std::min(std::min(std::abs(a.x()), std::abs(a.y())),
                                  std::min(std::abs(a.x() - a.y()), std::abs(a.x() + a.y())));
  if (nearest > 1.01 * std::max(change(a, b), change(a, c)) + apart) return 0;
  unsigned directions = 0;
  const auto test_line = [&](int direction, const auto& s, const auto& along) {
    const std::array<double, 3> side = {s(a), s(b), s(c)};
    const auto [low, high] = std::minmax({side[0], side[1], side[2]});
    if (low > apart || high < -apart) return;
    const std::array<double, 3> on = {along(a), along(b), along(c)};
    if (std::max({on[0], on[1], on[2]}) >= -apart) directions |= 1u << direction;
    if (std::min({on[0], on[1], on[2]}) <= apart) directions |= 1u << (direction + count / 2);
  };
  test_line(
      0, [](const Vec3& p) { return p.y(); }, [](const Vec3& p) { return p.x(); });
  test_line(
      1, [](const Vec3& p) { return p.y() - p.x(); }, [](const Vec3& p) { return p.x() + p.y(); });
  test_line(
      2, [](const Vec3& p) { return -p.x(); }, [](const Vec3& p) { return p.y(); });
  test_line(
      3, [](const Vec3& p) { return -p.x() - p.y(); }, [](const Vec3& p) { return p.y() - p.x(); });
  return static_cast<Directions>(directions);
}

std::optional<FreeDirections::Directions> FreeDirections::between(Sectors sectors) noexcept {
  const std::uint16_t directions = directions_between[sectors];
  if (directions == undecided) return std::nullopt;
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
  // A direction costs a pass over all cells, and one or two leave next to nothing to do: where that is less
  // than a pass, each cell gets a winding number of its own.
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

/// Triangles with all corners in one sector are near no direction; few others are left.
FreeDirections find_free_directions(const AxisVertices& vertices, std::span<const Triangle> triangles,
                                    const ProfileBoxes& boxes, const ProfileGrid& grid, double scale) {
  const auto& sector = vertices.sector;
  const auto corner = [&](Index v) -> const Vec3& { return vertices.exact[v].at; };
  const BoxScale box_scale(grid, vertices.units_per_mm);
  std::vector<Directions> taken(grid.cells(), 0);
  std::array<std::vector<Index>, FreeDirections::count> near;
  std::size_t count = 0;
  for (const Index t : boxes.across_sectors) {
    const auto& [a, b, c] = triangles[t];
    if ((sector[a] & sector[b] & sector[c]) != 0) continue;
    ++count;
    const bool clear = sector[a] != 0 && sector[b] != 0 && sector[c] != 0;
    const auto between = clear ? FreeDirections::between(sector[a] | sector[b] | sector[c]) : std::nullopt;
    const Directions directions = between ? *between : FreeDirections::near(corner(a), corner(b), corner(c));
    if (directions == 0) continue;
    for_each_cell(grid, box_scale.sides(boxes, t), corner(a), corner(b), corner(c),
                  [&](Index row, Index column) { taken[grid.cell(row, column)] |= directions; });
    for (unsigned left = directions; left != 0; left &= left - 1)
      near[static_cast<std::size_t>(std::countr_zero(left))].push_back(t);
  }
  // In a direction free in the cell of that radius and height: along the ray outwards.
  const auto winding_at = [&](int direction, double rho, double z) {
    const double angle = FreeDirections::angle_of(direction).radians();
    const Circle circle = circle_through(Vec3(rho * core::cosine(angle), rho * core::sine(angle), z), scale);
    TangentialWork work;
    int winding = 0;
    for (const Index t : near[static_cast<std::size_t>(direction)]) {
      const auto& [a, b, c] = triangles[t];
      winding += outward_crossing(circle, {&corner(a), &corner(b), &corner(c)}, work);
    }
    return winding;
  };
  // Two triangles of a direction cost as much as one cell; there are as many directions as these are near to.
  return {grid, taken, winding_at, std::max<std::size_t>(1, count / (2 * near.size()))};
}

}  // namespace condyle::tangential
