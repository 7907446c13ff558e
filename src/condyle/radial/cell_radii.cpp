#include <algorithm>
#include <cmath>
#include <limits>

#include <hwy/cache_control.h>

#include "condyle/radial/cell_lists.hpp"
#include "condyle/radial/cube_lists.hpp"

namespace condyle {
namespace {

/// One over the length of the direction to each corner of a face's cells, (n + 1)^2 of them.
std::vector<float> inverse_lengths(int n) {
  std::vector<float> lengths;
  lengths.reserve(static_cast<std::size_t>((n + 1) * (n + 1)));
  for (int row = 0; row <= n; ++row) {
    for (int column = 0; column <= n; ++column) {
      const double u = 2.0 * column / n - 1, w = 2.0 * row / n - 1;
      lengths.push_back(static_cast<float>(1 / std::sqrt(1 + u * u + w * w)));
    }
  }
  return lengths;
}

/// The cosine of the angle between a cell's middle and its corners, widened: half a diagonal of the face's
/// coordinates at most, and cos x >= 1 - x^2 / 2.
float cosine_to_corners(int n) {
  const double half_diagonal = std::sqrt(2.0) / n + 2 * list_margin;
  return static_cast<float>(std::max(0.0, 1 - half_diagonal * half_diagonal / 2));
}

ListedRadii listed_radii(const CubeMap& map, CellLists& lists) {
  const int n = map.cells_per_side();
  return {n,
          lists.triangle.data(),
          lists.plane.data(),
          lists.scale,
          lists.inverse_length.data(),
          cosine_to_corners(n),
          lists.nearest.data()};
}

RadiusWord word_of(const CellRadii& radii, const CellLists& lists) {
  const RadiusWord word = radii.greatest < radii.least
                              ? no_radii
                              : radius_word(lists.scale.code(radii.least), lists.scale.code(radii.greatest));
  return lists.starts_at_centre ? union_of(word, radius_word(0, 0)) : word;
}

/// Single rows, with the planes of their triangles copied side by side.
class RowAlone {
 public:
  explicit RowAlone(const ListedRadii& listed) : listed_(listed) {}

  CellRadii measure(CellLists& lists, Index cell) {
    const CellRow row = lists.row[cell];
    const std::uint32_t length = row.last - row.first;
    while (number_.size() < length + CellLists::entries_beyond)
      number_.push_back(static_cast<Index>(number_.size()));
    plane_.resize(std::max(plane_.size(), number_.size()));
    for (std::uint32_t i = 0; i < length; ++i)
      plane_[i] = plane_of(lists.forms[lists.triangle[row.first + i]]);
    listed_.triangle = number_.data(), listed_.plane = plane_.data();
    // Whole vectors are written: not to the lists, where another row follows.
    nearest_.resize(plane_.size());
    listed_.nearest = nearest_.data();
    const CellRadii radii = measure_row(listed_, cell, {0, length});
    std::copy_n(nearest_.data(), length, lists.nearest.data() + row.first);
    return radii;
  }

 private:
  ListedRadii listed_;
  std::vector<Index> number_;
  std::vector<TrianglePlane> plane_;
  std::vector<std::uint8_t> nearest_;
};

/// How many cells before its turn the planes of a cell's triangles are fetched.
constexpr std::size_t cells_ahead = 3;

}  // namespace

void find_radii(const CubeMap& map, CellLists& lists) {
  if (lists.inverse_length.empty()) lists.inverse_length = inverse_lengths(map.cells_per_side());
  const Index cells = map.cell_count();
  UninitialisedVector<CellRadii> radii(cells);
  if (lists.plane.empty()) {
    lists.plane.resize(lists.forms.size());
    std::transform(lists.forms.begin(), lists.forms.end(), lists.plane.begin(), plane_of);
  }
  measure_rows(listed_radii(map, lists), lists.row, radii.data());
  lists.plane = {};
  lists.least_squared = std::numeric_limits<float>::infinity(), lists.greatest_squared = 0;
  for (const CellRadii& cell : radii) {
    lists.least_squared = std::min(lists.least_squared, cell.least);
    lists.greatest_squared = std::max(lists.greatest_squared, cell.greatest);
  }
  lists.radii.resize(cells);
  for (Index cell = 0; cell < cells; ++cell) lists.radii[cell] = word_of(radii[cell], lists);
}

bool find_radii_in(const CubeMap& map, std::span<const Index> cells, CellLists& lists) {
  RowAlone alone(listed_radii(map, lists));
  bool are_changed = false;
  // Rows, what is listed in them and the planes of that all lie anywhere: each is fetched before its turn.
  for (const Index cell : cells) hwy::Prefetch(&lists.row[cell]);
  for (const Index cell : cells) {
    hwy::Prefetch(&lists.triangle[lists.row[cell].first]);
    hwy::Prefetch(&lists.radii[cell]);
  }
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (i + cells_ahead < cells.size()) {
      for (const Index t : lists.of(cells[i + cells_ahead])) hwy::Prefetch(&lists.forms[t]);
    }
    const Index cell = cells[i];
    const CellRadii radii = alone.measure(lists, cell);
    const RadiusWord word = word_of(radii, lists);
    are_changed |= word != lists.radii[cell];
    lists.radii[cell] = word;
    lists.least_squared = std::min(lists.least_squared, radii.least);
    lists.greatest_squared = std::max(lists.greatest_squared, radii.greatest);
  }
  return are_changed;
}

}  // namespace condyle
