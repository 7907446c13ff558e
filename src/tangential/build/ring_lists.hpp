#pragma once

#include <cstddef>
#include <span>

#include "core/uninitialised.hpp"
#include "tangential/build/cell_box.hpp"
#include "tangential/build/profile_boxes.hpp"
#include "tangential/build/profile_grid.hpp"

namespace condyle::tangential {

/// A triangle in the list of a cell, and its box within the cell.
struct RingEntry {
  Index triangle;
  CellBox box;
};

/// Which triangles a circle about the axis can meet: for each cell of the profile those whose box meets it.
///   offset_   0     2  2        5  ...      one per cell, plus one
///   entry_  | a b |  | c d e |    ...       cell i owns [offset_[i], offset_[i+1])
class RingLists {
 public:
  RingLists() = default;
  /// Cells of one size, about `cells` in number. Linear.
  RingLists(const AxisVertices& vertices, std::span<const Triangle> triangles, const ProfileBoxes& boxes,
            std::size_t cells);

  const ProfileGrid& grid() const noexcept { return grid_; }
  std::span<const RingEntry> of(std::size_t cell) const noexcept {
    return {entry_.data() + offset_[cell], offset_[cell + 1] - offset_[cell]};
  }
  /// All entries, and where those of each cell begin: one more than there are cells. Beyond the last entry
  /// there is padding for one vector of them.
  const RingEntry* entry_data() const noexcept { return entry_.data(); }
  const Index* offsets() const noexcept { return offset_.data(); }

  /// Entries of the longest list.
  std::size_t longest() const noexcept { return longest_; }
  std::size_t entries() const noexcept { return offset_.empty() ? 0 : offset_.back(); }
  std::size_t bytes() const noexcept {
    return offset_.size() * sizeof(Index) + entry_.size() * sizeof(RingEntry);
  }

 private:
  ProfileGrid grid_;
  std::size_t longest_ = 0;
  core::UninitialisedVector<Index> offset_;
  core::UninitialisedVector<RingEntry> entry_;
};

}  // namespace condyle::tangential
