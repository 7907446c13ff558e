#pragma once

#include <cassert>

#include "radial/build/cell_radii.hpp"

namespace condyle::radial {

/// Changes to single rows, which are whole then. Radii go with their entries, where there are any.
class Rows {
 public:
  Rows(CellEntries& entries, CellRadii* radii) : entries_(entries), radii_(radii) {}

  /// Linear in the row; the entry is there.
  void remove(Index cell, Index triangle) noexcept {
    CellRow& at = entries_.row[cell];
    std::uint32_t i = at.first;
    while (i < at.last && entries_.triangle[i] != triangle) ++i;
    assert(i < at.last);
    at = {at.first, at.last - 1};
    move(at.last, i);
  }

  /// The entry is not there. What is known of its radii is to be found then.
  void add(Index cell, Index triangle, const CellDop& dop) {
    if (entries_.row_end.empty()) set_row_ends();
    if (entries_.row[cell].last == entries_.row_end[cell]) move_to_end(cell);
    CellRow& at = entries_.row[cell];
    at = {at.first, at.last + 1};
    entries_.set(at.last - 1, triangle, dop);
  }

 private:
  std::uint32_t entry_end() const noexcept {
    return static_cast<std::uint32_t>(entries_.triangle.size() - CellEntries::entries_beyond);
  }

  /// Rows are still one behind the other, but for entries removed.
  void set_row_ends() {
    const std::size_t cells = entries_.row.size();
    entries_.row_end.resize(cells);
    for (std::size_t i = 0; i < cells; ++i)
      entries_.row_end[i] = i + 1 < cells ? entries_.row[i + 1].first : entry_end();
  }

  /// With capacity for as many entries again.
  void move_to_end(Index cell) {
    CellRow& at = entries_.row[cell];
    const std::uint32_t first = entry_end(), length = at.last - at.first, capacity = 2 * length + 4;
    entries_.resize(first + capacity);
    if (radii_ != nullptr) {
      radii_->nearest.resize(entries_.triangle.size());
      if (!radii_->of_entry.empty()) radii_->of_entry.resize(entries_.triangle.size());
    }
    for (std::uint32_t i = 0; i < length; ++i) move(at.first + i, first + i);
    for (std::uint32_t i = length; i < capacity; ++i) entries_.set(first + i, 0, {0, 0});
    at = {first, first + length};
    entries_.row_end[cell] = first + capacity;
  }

  void move(std::size_t from, std::size_t to) noexcept {
    entries_.set(to, entries_.triangle[from], {entries_.axis[from], entries_.diagonal[from]});
    if (radii_ == nullptr) return;
    radii_->nearest[to] = radii_->nearest[from];
    if (!radii_->of_entry.empty()) radii_->of_entry[to] = radii_->of_entry[from];
  }

  CellEntries& entries_;
  CellRadii* radii_;
};

}  // namespace condyle::radial
