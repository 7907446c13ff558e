#include "radial/build/cell_lists.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace condyle::radial {
namespace {

/// One triangle in one cell, before it is sorted into that cell's list.
struct Entry {
  Index cell, triangle;
};

}  // namespace

std::size_t CellLists::entry_count() const noexcept {
  std::size_t count = 0;
  for (const CellRow& cell : row) count += cell.last - cell.first;
  return count;
}

std::size_t CellLists::bytes() const noexcept {
  return row.size() * sizeof(CellRow) + triangle.size() * sizeof(Index) + radii.size() * sizeof(RadiusWord) +
         (box.size() + slant.size() + row_end.size() + entry_radii.size()) * sizeof(std::uint32_t) +
         nearest.size() + forms.size() * sizeof(ConeForms) + corner.size() * sizeof(Vec3) + face.size() +
         room.size() * sizeof(FaceRoom);
}

void CellLists::resize_entries(std::size_t count) {
  triangle.resize(count + entries_beyond);
  box.resize(count + entries_beyond);
  slant.resize(count + entries_beyond);
  nearest.resize(count + entries_beyond);
  if (!entry_radii.empty()) entry_radii.resize(count + entries_beyond);
  for (std::size_t i = count; i < count + entries_beyond; ++i) set_entry(i, 0, {0, 0});
}

void CellLists::split_rows() {
  // Two vectors: what is read at once costs the same in any order.
  constexpr std::uint32_t longest_whole = 32;
  struct Listed {
    Index triangle;
    CellOctagon octagon;
  };
  std::vector<Listed> sorted;  // for left alone, both, right alone: each may be the whole row
  for (CellRow& at : row) {
    const std::uint32_t length = at.last - at.first;
    if (length <= longest_whole || length >= CellRow::whole) continue;
    sorted.resize(std::max<std::size_t>(sorted.size(), std::size_t{3} * length));
    const std::array<Listed*, 3> part = {sorted.data(), sorted.data() + length, sorted.data() + 2 * length};
    std::array<Listed*, 3> end = part;
    for (std::uint32_t i = at.first; i < at.last; ++i) {
      // Of least u, and of 255 - greatest u: never both. Which, is not to be foretold.
      const std::uint32_t is_right = box[i] >> 7 & 1, is_left = box[i] >> 15 & 1;
      *end[1 + is_right - is_left]++ = {triangle[i], {box[i], slant[i]}};
    }
    std::uint32_t next = at.first;
    for (std::size_t k = 0; k < 3; ++k) {
      for (const Listed* listed = part[k]; listed != end[k]; ++listed)
        set_entry(next++, listed->triangle, listed->octagon);
    }
    at.right_begin = static_cast<std::uint16_t>(end[0] - part[0]);
    at.left_end = static_cast<std::uint16_t>(at.right_begin + (end[1] - part[1]));
  }
}

void CellLists::move_entry(std::size_t from, std::size_t to) noexcept {
  set_entry(to, triangle[from], {box[from], slant[from]});
  nearest[to] = nearest[from];
  if (!entry_radii.empty()) entry_radii[to] = entry_radii[from];
}

void CellLists::remove_entry(Index cell, Index triangle_listed) noexcept {
  CellRow& at = row[cell];
  std::uint32_t i = at.first;
  while (i < at.last && triangle[i] != triangle_listed) ++i;
  assert(i < at.last);
  at = {at.first, at.last - 1};
  move_entry(at.last, i);
}

void CellLists::add_entry(Index cell, Index triangle_listed, const CellOctagon& octagon) {
  CellRow& at = row[cell];
  if (row_end.empty()) {
    // Rows are still one behind the other, but for entries removed.
    row_end.resize(row.size());
    const auto entries = static_cast<std::uint32_t>(triangle.size() - entries_beyond);
    for (std::size_t i = 0; i < row.size(); ++i) row_end[i] = i + 1 < row.size() ? row[i + 1].first : entries;
  }
  if (at.last == row_end[cell]) {
    // To the end, with room for as many again.
    const auto first = static_cast<std::uint32_t>(triangle.size() - entries_beyond);
    const std::uint32_t length = at.last - at.first, capacity = 2 * length + 4;
    resize_entries(first + capacity);
    for (std::uint32_t i = 0; i < length; ++i) move_entry(at.first + i, first + i);
    for (std::uint32_t i = length; i < capacity; ++i) set_entry(first + i, 0, {0, 0});
    at = {first, first + length};
    row_end[cell] = first + capacity;
  }
  at = {at.first, at.last + 1};
  set_entry(at.last - 1, triangle_listed, octagon);
}

CellLists list_cells(const TriMesh& mesh, const CartesianMap& map) {
  const Index cells = map.cell_count();
  std::vector<Entry> entries;
  std::vector<std::uint32_t> length(cells, 0);
  std::vector<double> least(cells, std::numeric_limits<double>::infinity()), greatest(cells, 0);
  entries.reserve(4 * mesh.triangles.size());
  double nearest = std::numeric_limits<double>::infinity(), furthest = 0;
  for (Index t = 0; t < mesh.triangles.size(); ++t) {
    map.visit_cells(
        {mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2)}, [&](const CellOverlap& overlap) {
          entries.push_back({overlap.cell, t});
          ++length[overlap.cell];
          least[overlap.cell] = std::min(least[overlap.cell], overlap.min_radius);
          greatest[overlap.cell] = std::max(greatest[overlap.cell], overlap.max_radius);
          nearest = std::min(nearest, overlap.min_radius), furthest = std::max(furthest, overlap.max_radius);
        });
  }
  CellLists lists;
  lists.row.resize(cells);
  lists.triangle.resize(entries.size());
  lists.radii.assign(cells, no_radii);
  const auto squared = [](double radius) { return static_cast<float>(radius * radius); };
  lists.least_squared = squared(nearest), lists.greatest_squared = squared(furthest);
  if (!entries.empty()) lists.scale = {lists.least_squared, lists.greatest_squared};
  std::uint32_t first = 0;
  for (Index cell = 0; cell < cells; ++cell) {
    lists.row[cell] = {first, first};
    first += length[cell];
    if (length[cell] == 0) continue;
    // Rounding to float does not leave the code of a float's neighbour.
    lists.radii[cell] = radius_word(lists.scale.code(std::nextafter(squared(least[cell]), 0.0f)),
                                    lists.scale.code(std::nextafter(squared(greatest[cell]), 1e38f)));
  }
  for (const auto& [cell, triangle] : entries) lists.triangle[lists.row[cell].last++] = triangle;
  return lists;
}

}  // namespace condyle::radial
