#pragma once

#include <span>

#include "condyle/mesh.hpp"
#include "core/uninitialised.hpp"
#include "radial/build/cell_row.hpp"
#include "radial/exact/cell_dop.hpp"
#include "radial/exact/direction_map.hpp"

namespace condyle::radial {

/// Which triangles can be met in each cell of a direction map. Made by the build, changed row by row by
/// updates.
///   row        [0,2) [2,2) [2,5)  ...      one element per cell
///   triangle  | a b |     | c d e |  ...   cell i owns [row[i].first, row[i].last)
struct CellEntries {
  /// Entries beyond the last one that vector code may read: a vector that starts on it, and one fetched
  /// ahead.
  static constexpr std::size_t entries_beyond = 32;

  core::UninitialisedVector<CellRow> row;
  core::UninitialisedVector<Index> triangle;

  /// The CellDop of each entry, of a cube map: its vector code reads beyond the last entry.
  core::UninitialisedVector<std::uint32_t> axis, diagonal;
  /// Where the capacity of each row ends, once entries have moved: rows are then no longer in the order of
  /// cells.
  std::vector<std::uint32_t> row_end;

  std::span<const Index> of(Index cell) const noexcept {
    return {triangle.data() + row[cell].first, triangle.data() + row[cell].last};
  }
  EntryView view() const noexcept { return {row.data(), triangle.data(), axis.data(), diagonal.data()}; }
  std::size_t count() const noexcept;
  std::size_t bytes() const noexcept;

  /// Capacity for so many entries, and padding of a vector beyond them.
  void resize(std::size_t entries);
  void set(std::size_t at, Index triangle_number, const CellDop& dop) noexcept {
    triangle[at] = triangle_number;
    axis[at] = dop.axis;
    diagonal[at] = dop.diagonal;
  }
  /// Sorts long rows by halves of their cells. Linear in their entries.
  void split_rows();
};

}  // namespace condyle::radial
