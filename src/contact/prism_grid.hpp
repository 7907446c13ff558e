#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "contact/prism.hpp"

/// Prisms by where they lie seen along z, so that those of one body meet those of another without asking all of them.

namespace condyle::contact::prisms {

/// Seen along z; from 0 to `top` in z.
struct Crop {
  double low_x, high_x, low_y, high_y, top;

  /// A triangle with unchanged z.
  Polygon of(const Prism& prism) const noexcept {
    Polygon part;
    for (const Corner& corner : prism.corners) part.push(corner);
    if (prism.low_x < low_x) part = cut(part, [&](std::size_t k) { return part.corners[k].x - low_x; });
    if (prism.high_x > high_x) part = cut(part, [&](std::size_t k) { return high_x - part.corners[k].x; });
    if (prism.low_y < low_y) part = cut(part, [&](std::size_t k) { return part.corners[k].y - low_y; });
    if (prism.high_y > high_y) part = cut(part, [&](std::size_t k) { return high_y - part.corners[k].y; });
    return part;
  }
};

/// Prisms of one body by the cells of a grid over the crop.
///
///     start_    0    2 2      5 ...     one entry for each cell, and one
///     prism_  | a b | | c d e | ...
class Grid {
 public:
  Grid(const Crop& crop, std::vector<Prism> prisms) : crop_(crop), prisms_(std::move(prisms)) {
    double width = 0, height = 0;
    for (const Prism& prism : prisms_)
      width += prism.high_x - prism.low_x, height += prism.high_y - prism.low_y;
    const double count = std::max<double>(1, static_cast<double>(prisms_.size()));
    // About as large as a triangle: then a triangle has some four cells, and a cell the triangles of its column.
    const auto cells_along = [&](double extent, double of_triangles) {
      const double cells = of_triangles > 0 ? extent * count / of_triangles : 1;
      return static_cast<Index>(std::clamp(cells, 1.0, std::min(most_cells_along, 4 * count)));
    };
    columns_ = cells_along(crop.high_x - crop.low_x, width);
    rows_ = cells_along(crop.high_y - crop.low_y, height);
    while (double{1} * columns_ * rows_ > 4 * count + 4) (columns_ > rows_ ? columns_ : rows_) /= 2;
    per_x_ = crop.high_x > crop.low_x ? columns_ / (crop.high_x - crop.low_x) : 0;
    per_y_ = crop.high_y > crop.low_y ? rows_ / (crop.high_y - crop.low_y) : 0;
    start_.assign(std::size_t{columns_} * rows_ + 1, 0);
    cells_.reserve(prisms_.size());
    for (const Prism& prism : prisms_) {
      cells_.push_back(cells_of(prism));
      visit(cells_.back(), [&](std::size_t cell) { ++start_[cell + 1]; });
    }
    for (std::size_t cell = 1; cell < start_.size(); ++cell) start_[cell] += start_[cell - 1];
    prism_.resize(start_.back());
    std::vector<Index> next(start_.begin(), start_.end() - 1);
    for (Index i = 0; i < prisms_.size(); ++i)
      visit(cells_[i], [&](std::size_t cell) { prism_[next[cell]++] = i; });
  }

  const std::vector<Prism>& prisms() const noexcept { return prisms_; }

  /// take(number, prism) once for each prism whose box may share a column with this one's.
  template <class Take>
  void for_each_near(const Prism& prism, const Take& take) const {
    const Cells cells = cells_of(prism);
    for (Index row = cells.first_row; row <= cells.last_row; ++row) {
      for (Index column = cells.first_column; column <= cells.last_column; ++column) {
        const std::size_t cell = std::size_t{row} * columns_ + column;
        for (Index i = start_[cell]; i < start_[cell + 1]; ++i) {
          const Cells& other = cells_[prism_[i]];
          // A pair is taken in the first cell that both have.
          if (column != std::max(cells.first_column, other.first_column) ||
              row != std::max(cells.first_row, other.first_row))
            continue;
          const Prism& found = prisms_[prism_[i]];
          if (found.may_share_a_column_with(prism)) take(prism_[i], found);
        }
      }
    }
  }

 private:
  static constexpr double most_cells_along = 2048;

  struct Cells {
    Index first_column, last_column, first_row, last_row;
  };
  Cells cells_of(const Prism& prism) const noexcept {
    const auto cell = [](double at, double per, Index count) {
      return static_cast<Index>(std::clamp(at * per, 0.0, static_cast<double>(count - 1)));
    };
    return {cell(prism.low_x - crop_.low_x, per_x_, columns_),
            cell(prism.high_x - crop_.low_x, per_x_, columns_),
            cell(prism.low_y - crop_.low_y, per_y_, rows_), cell(prism.high_y - crop_.low_y, per_y_, rows_)};
  }
  template <class Visit>
  void visit(const Cells& cells, const Visit& visit_cell) const {
    for (Index row = cells.first_row; row <= cells.last_row; ++row)
      for (Index column = cells.first_column; column <= cells.last_column; ++column)
        visit_cell(std::size_t{row} * columns_ + column);
  }

  Crop crop_;
  std::vector<Prism> prisms_;
  Index columns_ = 1, rows_ = 1;
  double per_x_ = 0, per_y_ = 0;
  std::vector<Index> start_, prism_;
  std::vector<Cells> cells_;
};

}  // namespace condyle::contact::prisms
