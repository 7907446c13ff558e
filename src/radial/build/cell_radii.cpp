#include "radial/build/cell_radii.hpp"

#include <algorithm>
#include <cmath>

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

RadiiView radii_view_of(const CubeMap& map, const CubeTable& table, std::span<const TrianglePlane> planes,
                        CellRadii& radii) {
  const int n = map.cells_per_side();
  return {.cells_per_side = n,
          .triangle = table.entries.triangle.data(),
          .plane = planes.data(),
          .scale = table.forms.scale,
          .inverse_length = radii.inverse_length.data(),
          .cosine = cosine_to_corners(n),
          .of_every_cell = radii.starts_at_centre ? packed_interval(0, 0) : no_radii,
          .nearest = radii.nearest.data(),
          .entry_radii = radii.of_entry.empty() ? nullptr : radii.of_entry.data()};
}

}  // namespace

void find_radii(const CubeMap& map, const CubeTable& table, CellRadii& radii) {
  if (radii.inverse_length.empty()) radii.inverse_length = inverse_lengths(map.cells_per_side());
  const auto& forms = table.forms.edge_functions;
  core::UninitialisedVector<TrianglePlane> planes(forms.size());
  std::transform(forms.begin(), forms.end(), planes.begin(), plane_of);
  radii.nearest.resize(table.entries.triangle.size());
  if (!radii.of_entry.empty()) radii.of_entry.resize(table.entries.triangle.size());
  radii.of_cell.resize(map.cell_count());
  const SurfaceRadii all =
      measure_rows(radii_view_of(map, table, planes, radii), table.entries.row, radii.of_cell.data());
  radii.least_squared = all.least, radii.greatest_squared = all.greatest;
}

ChangedRadii find_radii_in(const CubeMap& map, const CubeTable& table, const ChangedTriangles& changed,
                           CellRadii& radii) {
  if (radii.of_entry.empty()) {
    radii.of_entry.resize(table.entries.triangle.size());
    find_radii(map, table, radii);
    return {.may_be_all = true};
  }
  SurfaceRadii all{radii.least_squared, radii.greatest_squared};
  // Rows lie anywhere.
  for (const Index cell : changed.cells)
    __builtin_prefetch(&table.entries.row[cell]), __builtin_prefetch(&radii.of_cell[cell]);
  core::UninitialisedVector<ChangedEntry> scratch(changed.entry.size());
  ChangedRadii out;
  out.cells.resize(changed.cells.size());
  out.cells.resize(measure_changed(radii_view_of(map, table, {}, radii), table.entries.row.data(), changed,
                                   scratch.data(), radii.of_cell.data(), all, out.cells.data()));
  radii.least_squared = all.least, radii.greatest_squared = all.greatest;
  return out;
}

}  // namespace condyle::radial
