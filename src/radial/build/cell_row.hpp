#pragma once

#include <cstdint>

namespace condyle::radial {

/// The triangles of one cell: [first, last) of the lists. In long rows those of the cell's left half (u below
/// its middle) come first and those of the right half last:
///
///     first      | left half only  | both | right half only  |      last
///                                  ^      ^
///                        right_begin      left_end                  counted from `first`
struct CellRow {
  static constexpr std::uint16_t whole = 0xffff;

  std::uint32_t first, last;
  std::uint16_t left_end = whole, right_begin = 0;

  /// The entries that a point with this axis part can meet. In which half it is cannot be predicted: bits choose, not
  /// branches.
  constexpr CellRow half_at(std::uint32_t axis) const noexcept {
    const std::uint32_t is_right = 0u - (axis >> 7 & 1u), end = left_end == whole ? last : first + left_end;
    return {first + (right_begin & is_right), end ^ ((end ^ last) & is_right)};
  }
};

/// The entries of a table's cells.
struct EntryView {
  const CellRow* row;
  const std::uint32_t* triangle;
  const std::uint32_t *axis, *diagonal;  ///< of each entry's triangle in its cell, see CellDop
};

}  // namespace condyle::radial
