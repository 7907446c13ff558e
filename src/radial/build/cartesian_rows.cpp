#include "radial/build/cartesian_rows.hpp"

#include "radial/build/rows.hpp"

namespace condyle::radial {
namespace {

std::vector<Vec3> directions_of(const Points& vertices) {
  std::vector<Vec3> directions(vertices.size());
  for (std::size_t v = 0; v < vertices.size(); ++v) directions[v] = vertices[v].stableNormalized();
  return directions;
}

/// Calls visit(triangle, box) for each triangle.
void for_each_box(const TriMesh& mesh, const CartesianMap& map, const auto& visit) {
  const std::vector<Vec3> direction = directions_of(mesh.vertices);
  for (Index t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    visit(t, map.box_of(direction[a], direction[b], direction[c]));
  }
}

}  // namespace

void build(const TriMesh& mesh, const CartesianMap& map, CartesianRows& rows) {
  rows.box.resize(mesh.triangles.size());
  std::vector<std::uint32_t> length(map.cell_count(), 0);
  for_each_box(mesh, map, [&](Index t, const CartesianBox& box) {
    rows.box[t] = box;
    map.visit_cells(box, [&](Index cell) { ++length[cell]; });
  });
  CellEntries& entries = rows.entries;
  entries.row.resize(map.cell_count());
  entries.row_end.clear();
  std::uint32_t first = 0;
  for (Index cell = 0; cell < map.cell_count(); ++cell) {
    entries.row[cell] = {first, first};
    first += length[cell];
  }
  entries.resize(first);
  for (Index t = 0; t < mesh.triangles.size(); ++t)
    map.visit_cells(rows.box[t], [&](Index cell) { entries.set(entries.row[cell].last++, t, {0, 0}); });
}

void follow_vertices(const TriMesh& mesh, const CartesianMap& map, CartesianRows& rows) {
  Rows changed(rows.entries, nullptr);
  for_each_box(mesh, map, [&](Index t, const CartesianBox& box) {
    if (box == rows.box[t]) return;
    map.visit_cells(rows.box[t], [&](Index cell) { changed.remove(cell, t); });
    map.visit_cells(box, [&](Index cell) { changed.add(cell, t, {0, 0}); });
    rows.box[t] = box;
  });
}

}  // namespace condyle::radial
