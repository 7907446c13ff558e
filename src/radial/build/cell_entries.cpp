#include "radial/build/cell_entries.hpp"

#include <array>

namespace condyle::radial {

std::size_t CellEntries::count() const noexcept {
  std::size_t count = 0;
  for (const CellRow& cell : row) count += cell.last - cell.first;
  return count;
}

std::size_t CellEntries::bytes() const noexcept {
  return row.size() * sizeof(CellRow) + triangle.size() * sizeof(Index) +
         (axis.size() + diagonal.size() + row_end.size()) * sizeof(std::uint32_t);
}

void CellEntries::resize(std::size_t entries) {
  triangle.resize(entries + entries_beyond);
  axis.resize(entries + entries_beyond);
  diagonal.resize(entries + entries_beyond);
  for (std::size_t i = entries; i < entries + entries_beyond; ++i) set(i, 0, {0, 0});
}

void CellEntries::split_rows() {
  // Two vectors: what is read at once costs the same in any order.
  constexpr std::uint32_t longest_whole = 32;
  struct Entry {
    Index triangle;
    CellDop dop;
  };
  std::array<std::vector<Entry>, 3> parts;  // left only, both, right only
  for (CellRow& at : row) {
    const std::uint32_t length = at.last - at.first;
    if (length <= longest_whole || length >= CellRow::whole) continue;
    for (auto& part : parts) part.clear();
    for (std::uint32_t i = at.first; i < at.last; ++i) {
      // Bits of least u, and of 255 - greatest u: never both.
      const std::uint32_t is_right = axis[i] >> 7 & 1, is_left = axis[i] >> 15 & 1;
      parts[1 + is_right - is_left].push_back({triangle[i], {axis[i], diagonal[i]}});
    }
    std::uint32_t next = at.first;
    for (const auto& part : parts)
      for (const Entry& entry : part) set(next++, entry.triangle, entry.dop);
    at.right_begin = static_cast<std::uint16_t>(parts[0].size());
    at.left_end = static_cast<std::uint16_t>(parts[0].size() + parts[1].size());
  }
}

}  // namespace condyle::radial
