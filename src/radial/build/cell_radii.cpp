#include <algorithm>
#include <cmath>

#include <hwy/cache_control.h>

#include "radial/build/cell_lists.hpp"
#include "radial/build/cube_lists.hpp"

namespace condyle::radial {
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
          lists.starts_at_centre ? radius_word(0, 0) : no_radii,
          lists.nearest.data(),
          lists.entry_radii.empty() ? nullptr : lists.entry_radii.data()};
}

}  // namespace

void find_radii(const CubeMap& map, CellLists& lists) {
  if (lists.inverse_length.empty()) lists.inverse_length = inverse_lengths(map.cells_per_side());
  if (lists.plane.empty()) {
    lists.plane.resize(lists.forms.size());
    std::transform(lists.forms.begin(), lists.forms.end(), lists.plane.begin(), plane_of);
  }
  if (!lists.entry_radii.empty()) lists.entry_radii.resize(lists.triangle.size());
  lists.radii.resize(map.cell_count());
  const SurfaceRadii all = measure_rows(listed_radii(map, lists), lists.row, lists.radii.data());
  lists.least_squared = all.least, lists.greatest_squared = all.greatest;
  lists.plane = {};
}

ChangedRadii find_radii_in(const CubeMap& map, const TouchedTriangles& touched, CellLists& lists) {
  if (lists.entry_radii.empty()) {
    lists.entry_radii.resize(lists.triangle.size());
    find_radii(map, lists);
    return {.may_be_all = true};
  }
  SurfaceRadii all{lists.least_squared, lists.greatest_squared};
  // Rows lie anywhere.
  for (const Index cell : touched.cells) hwy::Prefetch(&lists.row[cell]), hwy::Prefetch(&lists.radii[cell]);
  core::UninitialisedVector<ChangedEntry> room(touched.listed.size());
  ChangedRadii changed;
  changed.cells.resize(touched.cells.size());
  changed.cells.resize(measure_touched(listed_radii(map, lists), lists.row.data(), touched, room.data(),
                                       lists.radii.data(), all, changed.cells.data()));
  lists.least_squared = all.least, lists.greatest_squared = all.greatest;
  return changed;
}

}  // namespace condyle::radial
