#include "radial/build/cube_lists.hpp"

#include <algorithm>
#include <limits>

#include "radial/build/cube_listing.hpp"

namespace condyle::radial {
namespace {

/// Radii of vertices, and of triangles where their edges do not come much nearer: those have no least radius
/// of their own then.
RadiusScale scale_of(std::span<const Vec3> vertices) {
  double least = std::numeric_limits<double>::infinity(), greatest = 0;
  for (const Vec3& v : vertices) {
    least = std::min(least, v.squaredNorm()), greatest = std::max(greatest, v.squaredNorm());
  }
  if (!(least <= greatest)) return {};
  return {static_cast<float>(0.75 * least), static_cast<float>(greatest * (1 + 0x1p-15))};
}

void sort_into_rows(const CubeListing& listing, const CubeMap& map, CellLists& lists) {
  const Index cells = map.cell_count();
  lists.row.resize(cells);
  lists.row_end.clear();
  std::uint32_t first = 0;
  for (Index cell = 0; cell < cells; ++cell) {
    lists.row[cell] = {first, first};
    first += listing.length(cell);
  }
  lists.resize_entries(first);
  for (const ListedTriangle& entry : listing.entries())
    lists.set_entry(lists.row[entry.cell].last++, entry.triangle, entry.octagon);
  lists.split_rows();
}

}  // namespace

void list_all(const TriMesh& mesh, const CubeMap& map, const PlacedVertices& placed, CellLists& lists) {
  CubeListing listing(mesh.vertices, mesh.triangles, map, placed);
  listing.list();
  sort_into_rows(listing, map, lists);
  lists.has_clipped = listing.has_clipped();
}

void measure(const TriMesh& mesh, CellLists& lists) {
  lists.corner.resize(mesh.vertices.size());
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) lists.corner[i] = mesh.vertices[i];
  lists.scale = scale_of(lists.corner);
  lists.forms.resize(mesh.triangles.size());
  lists.plane.resize(mesh.triangles.size());
  lists.unknown.clear();
  MeshView view = view_of(mesh.vertices, mesh.triangles);
  view.xyz = lists.corner.data()->data();
  measure_triangles(view, 0, mesh.triangles.size(), lists.scale, lists.forms.data(), lists.plane.data(),
                    lists.unknown);
}

CellLists list_cells(const TriMesh& mesh, const CubeMap& map) {
  CellLists lists;
  list_cells(mesh, map, lists);
  find_radii(map, lists);
  return lists;
}

void list_cells(const TriMesh& mesh, const CubeMap& map, CellLists& lists) {
  core::UninitialisedVector<std::uint8_t> face(mesh.vertices.size());
  core::UninitialisedVector<FacePoint> place(mesh.vertices.size());
  place_vertices(view_of(mesh.vertices, mesh.triangles), face.data(), place.data());
  lists.room.clear();
  list_all(mesh, map, {face.data(), place.data(), nullptr}, lists);
  measure(mesh, lists);
}

}  // namespace condyle::radial
