#include "tangential/build/rings.hpp"

#include <utility>

namespace condyle::tangential {

Rings build_rings(const TriMesh& mesh, const AxisFrame& frame, std::size_t cells) {
  AxisVertices vertices = vertices_in_axis_frame(mesh.vertices, frame);
  core::UninitialisedVector<Triangle> triangles(mesh.triangles.begin(), mesh.triangles.end());
  const ProfileBoxes boxes = profile_boxes(vertices.rounded, triangles);
  const double scale = boxes.scale / vertices.units_per_mm;
  RingLists lists(vertices, triangles, boxes, cells);
  FreeDirections free_directions = find_free_directions(vertices, triangles, boxes, lists.grid(), scale);
  return {.frame = frame,
          .vertices = std::move(vertices.exact),
          .triangles = std::move(triangles),
          .scale = scale,
          .lists = std::move(lists),
          .free_directions = std::move(free_directions)};
}

RingTableSize size_of(const Rings& rings) noexcept {
  const std::size_t cells = rings.grid().cells();
  RingTableSize size{};
  size.cells = cells, size.entries = rings.lists.entries(), size.longest_list = rings.lists.longest();
  for (std::size_t cell = 0; cell < cells; ++cell) size.cells_in_use += !rings.lists.of(cell).empty();
  size.bytes = rings.lists.bytes() + rings.free_directions.bytes() +
               rings.triangles.size() * sizeof(Triangle) + rings.vertices.size() * sizeof(AxisVertex);
  if (size.cells_in_use > 0)
    size.mean_list = static_cast<double>(size.entries) / static_cast<double>(size.cells_in_use);
  if (!rings.triangles.empty())
    size.bytes_per_triangle = static_cast<double>(size.bytes) / static_cast<double>(rings.triangles.size());
  return size;
}

}  // namespace condyle::tangential
