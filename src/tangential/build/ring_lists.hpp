#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/uninitialised.hpp"
#include "tangential/build/profile_boxes.hpp"
#include "tangential/exact/profile.hpp"
#include "tangential/query/circle_places.hpp"

namespace condyle::tangential {

/// Circles and the triangles whose boxes hold them, side by side: circle by circle.
struct CirclePairs {
  core::UninitialisedVector<Index> triangle, circle;
};

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
  /// visit(triangle) for those whose boxes reach the circle's height in its cell or further out, some more
  /// than once.
  template <class Visit>
  void for_each_outwards(const CirclePlace& circle, const Visit& visit) const {
    const std::size_t row_end = (circle.cell / grid_.columns + 1) * grid_.columns;
    for (Index i = offset_[circle.cell]; i < offset_[row_end]; ++i) {
      const auto [triangle, box] = entry_[i];
      const bool above = (box & 0xff) <= (circle.at & 0xff);
      const bool below = (box >> 8 & 0xff) <= (circle.at >> 8 & 0xff);
      if (above & below) visit(triangle);
    }
  }
  /// Asks memory for where the list of the cell is, and then for the list.
  void fetch_offset(Index cell) const noexcept { __builtin_prefetch(&offset_[cell]); }
  void fetch_list(Index cell) const noexcept { __builtin_prefetch(entry_.data() + offset_[cell]); }

  /// Pairs of circles from number `first` on. Ends before a circle for which there might be no room, and
  /// returns how many circles are done: one more at least.
  std::size_t find(std::span<const CirclePlace> circles, std::size_t first, CirclePairs& pairs) const;

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
