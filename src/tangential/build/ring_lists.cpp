#include "tangential/build/ring_lists.hpp"

#include <algorithm>
#include <utility>

#include "tangential/build/box_cells.hpp"

namespace condyle::tangential {
namespace {

/// Entries beyond the last one, for a vector that starts on it.
constexpr std::size_t padding = 16;

/// Bins triangles into the cells of their boxes: first to count the entries, then to write them.
class Binning {
 public:
  Binning(const ProfileGrid& grid, const AxisVertices& vertices, std::span<const Triangle> triangles,
          const ProfileBoxes& boxes)
      : grid_(grid),
        vertices_(vertices.exact),
        triangles_(triangles),
        boxes_(boxes),
        scale_(grid, vertices.units_per_mm) {}

  /// Adds to the count of each cell how many entries it gets.
  void count(Index* counts) const {
    for_each_batch([&](const BoxCells& batch, std::size_t first) {
      for (const BoxCells::Corner& corner : batch.corner) {
        for (const Index slot : std::span(corner.in_use).first(corner.count)) ++counts[corner.cell[slot]];
      }
      for_each_of_large(batch, first, [&](std::size_t cell, CellBox, Index) { ++counts[cell]; });
    });
  }

  /// Writes the entries of each triangle; `next` has for each cell where its next entry goes.
  void write(Index* next, RingEntry* entries) const {
    for_each_batch([&](const BoxCells& batch, std::size_t first) {
      for (const BoxCells::Corner& corner : batch.corner) {
        for (const Index slot : std::span(corner.in_use).first(corner.count))
          entries[next[corner.cell[slot]]++] = {static_cast<Index>(first + slot), corner.box[slot]};
      }
      for_each_of_large(batch, first, [&](std::size_t cell, CellBox part, Index t) {
        entries[next[cell]++] = {t, part};
      });
    });
  }

 private:
  template <class Visit>
  void for_each_batch(const Visit& visit) const {
    BoxCells batch;
    for (std::size_t first = 0; first < triangles_.size(); first += batch.most) {
      scale_.cells(boxes_, first, std::min(batch.most, triangles_.size() - first), batch);
      visit(batch, first);
    }
  }

  /// visit(cell, box, triangle) for the cells of the large boxes of a batch.
  template <class Visit>
  void for_each_of_large(const BoxCells& batch, std::size_t first, const Visit& visit) const {
    for (std::size_t k = 0; k < batch.large_count; ++k) {
      const auto t = static_cast<Index>(first + batch.large[k]);
      const BoxSides sides = scale_.sides(boxes_, t);
      const auto& [a, b, c] = triangles_[t];
      for_each_cell(
          grid_, sides, vertices_[a].at, vertices_[b].at, vertices_[c].at,
          [&](Index row, Index column) { visit(grid_.cell(row, column), sides.in_cell(row, column), t); });
    }
  }

  const ProfileGrid& grid_;
  std::span<const AxisVertex> vertices_;
  std::span<const Triangle> triangles_;
  const ProfileBoxes& boxes_;
  BoxScale scale_;
};

}  // namespace

RingLists::RingLists(const AxisVertices& vertices, std::span<const Triangle> triangles,
                     const ProfileBoxes& boxes, std::size_t cells) {
  if (!triangles.empty()) {
    const double mm = 1 / vertices.units_per_mm;
    grid_ = ProfileGrid::over({boxes.rho_min * mm, boxes.rho_max * mm, boxes.z_min * mm, boxes.z_max * mm},
                              cells);
  }
  offset_.resize(grid_.cells() + 1);
  std::fill(offset_.begin(), offset_.end(), 0);
  const Binning binning(grid_, vertices, triangles, boxes);
  // While entries are written, each cell's offset stands one to the right, and moves to its end.
  Index* const next = offset_.data() + 1;
  binning.count(next);
  Index sum = 0;
  for (std::size_t cell = 0; cell < grid_.cells(); ++cell) {
    longest_ = std::max<std::size_t>(longest_, next[cell]);
    sum += std::exchange(next[cell], sum);
  }
  entry_.resize(sum + padding);
  binning.write(next, entry_.data());
}

}  // namespace condyle::tangential
