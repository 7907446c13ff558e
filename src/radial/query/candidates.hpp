#pragma once

#include <span>
#include <variant>
#include <vector>

#include "radial/build/cell_entries.hpp"
#include "radial/query/penetration_passes.hpp"

namespace condyle::radial {

using DirectionMap = std::variant<CartesianMap, CubeMap>;

/// Triangles that the rays through some points may meet, gathered for many points at once.
class Candidates {
 public:
  /// Borrows both.
  Candidates(const DirectionMap& map, const CellEntries& entries) : map_(map), entries_(entries) {}

  /// For all of the points, which may be at the centre: those have none. Scratch of the last call is used
  /// again.
  void gather(std::span<const Vec3> points);

  std::span<const Index> of(std::size_t point) const noexcept { return of_point_[point]; }

 private:
  void gather(const CubeMap& map, std::span<const Vec3> points);
  void gather(const CartesianMap& map, std::span<const Vec3> points);

  const DirectionMap& map_;
  const CellEntries& entries_;
  std::vector<std::span<const Index>> of_point_;
  std::vector<CellPlace> place_;
  std::vector<std::uint32_t> number_, end_;
  core::UninitialisedVector<Index> found_;
};

}  // namespace condyle::radial
