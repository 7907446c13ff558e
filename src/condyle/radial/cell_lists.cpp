#include "condyle/radial/cell_lists.hpp"

#include <cmath>

namespace condyle {
namespace {

/// One triangle in one cell, before it is sorted into that cell's list.
struct Entry {
  Index cell, triangle;
};

}  // namespace

std::size_t CellLists::bytes() const noexcept {
  return row.size() * sizeof(CellRow) + triangle.size() * sizeof(Index) + radii.size() * sizeof(RadiusWord) +
         (box.size() + slant.size()) * sizeof(std::uint32_t) + forms.size() * sizeof(ConeForms) +
         corner.size() * sizeof(Vec3);
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
  if (!entries.empty()) lists.scale = {squared(nearest), squared(furthest)};
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

}  // namespace condyle
