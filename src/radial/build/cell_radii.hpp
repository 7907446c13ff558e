#pragma once

#include "radial/build/cube_table.hpp"

namespace condyle::radial {

/// Between which radii the surface lies in each cell of a cube map: what the fast penetration query rejects
/// points by, and nothing else reads.
struct CellRadii {
  std::vector<PackedInterval> of_cell;            ///< no_radii where no triangle is met
  float least_squared = 0, greatest_squared = 0;  ///< of all cells
  bool starts_at_centre = false;                  ///< No radius is too small: the centre is inside.
  /// Upper half of the code of the least squared radius of each entry's triangle; vector code reads beyond
  /// the last entry.
  core::UninitialisedVector<std::uint8_t> nearest;
  /// Interval of each entry's triangle in its cell; kept once some vertices have moved, empty until then.
  core::UninitialisedVector<PackedInterval> of_entry;
  std::vector<float> inverse_length;  ///< of the directions to a face's cell corners

  std::size_t bytes() const noexcept {
    return (of_cell.size() + of_entry.size()) * sizeof(PackedInterval) + nearest.size();
  }
};

/// Radii of all cells, hulls of those of all parts of their triangles within them; those of each entry where
/// they are kept. `starts_at_centre` is given. Linear in entries.
void find_radii(const CubeMap& map, const CubeTable& table, CellRadii& radii);

/// Cells whose radii differ from before: those named, or perhaps all.
struct ChangedRadii {
  bool may_be_all = false;
  std::vector<Index> cells = {};
};

/// Radii of the cells of some triangles, on the scale that there is. Those of all entries are found and kept
/// from the first such call on.
ChangedRadii find_radii_in(const CubeMap& map, const CubeTable& table, const ChangedTriangles& changed,
                           CellRadii& radii);

}  // namespace condyle::radial
