#include "radial/build/cube_table.hpp"

#include <algorithm>
#include <limits>

#include "radial/build/cube_binning.hpp"

namespace condyle::radial {
namespace {

/// Radii of vertices, and of triangles where their edges do not come much nearer: those have no least radius
/// of their own then.
IntervalScale scale_of(std::span<const Vec3> vertices) {
  double least = std::numeric_limits<double>::infinity(), greatest = 0;
  for (const Vec3& v : vertices) {
    least = std::min(least, v.squaredNorm()), greatest = std::max(greatest, v.squaredNorm());
  }
  if (!(least <= greatest)) return {};
  return {static_cast<float>(0.75 * least), static_cast<float>(greatest * (1 + 0x1p-15))};
}

void sort_into_rows(const CubeBinning& binning, const CubeMap& map, CellEntries& entries) {
  const Index cells = map.cell_count();
  entries.row.resize(cells);
  entries.row_end.clear();
  std::uint32_t first = 0;
  for (Index cell = 0; cell < cells; ++cell) {
    entries.row[cell] = {first, first};
    first += binning.length(cell);
  }
  entries.resize(first);
  binning.for_each_entry([&](const CellEntry& entry) {
    entries.set(entries.row[entry.cell].last++, entry.triangle, entry.dop);
  });
  entries.split_rows();
}

}  // namespace

void bin_all(const TriMesh& mesh, const CubeMap& map, const PlacedVertices& placed, CubeTable& table) {
  CubeBinning binning(mesh.vertices, mesh.triangles, map, placed);
  binning.bin();
  sort_into_rows(binning, map, table.entries);
  table.has_clipped = binning.has_clipped();
}

void place_corners(const TriMesh& mesh, TriangleForms& forms) {
  forms.corner.resize(mesh.vertices.size());
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) forms.corner[i] = mesh.vertices[i];
}

void measure(const TriMesh& mesh, TriangleForms& forms) {
  forms.scale = scale_of(forms.corner);
  forms.edge_functions.resize(mesh.triangles.size());
  forms.uncertain.clear();
  MeshView view = view_of(mesh.vertices, mesh.triangles);
  view.xyz = forms.corner.data()->data();
  measure_triangles(view, 0, mesh.triangles.size(), forms.scale, forms.edge_functions.data(),
                    forms.uncertain);
}

void build_rows(const TriMesh& mesh, const CubeMap& map, CubeTable& table) {
  core::UninitialisedVector<std::uint8_t> face(mesh.vertices.size());
  core::UninitialisedVector<FacePoint> place(mesh.vertices.size());
  place_vertices(view_of(mesh.vertices, mesh.triangles), face.data(), place.data());
  table.slack = {};
  bin_all(mesh, map, {face.data(), place.data(), nullptr}, table);
}

void build(const TriMesh& mesh, const CubeMap& map, CubeTable& table) {
  build_rows(mesh, map, table);
  place_corners(mesh, table.forms);
  measure(mesh, table.forms);
}

}  // namespace condyle::radial
