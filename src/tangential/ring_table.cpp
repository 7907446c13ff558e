#include "tangential/ring_table.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <string>
#include <vector>

#include "condyle/error.hpp"
#include "core/predicates.hpp"
#include "mesh/vertical_ray.hpp"
#include "tangential/build/box_cells.hpp"

namespace condyle {
namespace {

std::size_t cells_for(const TriMesh& mesh, const RingTableOptions& options) {
  // 64 cells per triangle is far past the point where lists stop getting shorter.
  if (!(options.cells_per_triangle > 0 && options.cells_per_triangle <= 64)) {
    throw UsageError("cells_per_triangle is " + std::to_string(options.cells_per_triangle) +
                     ", not above 0 and at most 64");
  }
  return static_cast<std::size_t>(
      std::ceil(options.cells_per_triangle * static_cast<double>(mesh.triangles.size())));
}

}  // namespace

void TangentialHits::resize(std::size_t count) {
  state.resize(count), winding.resize(count), angular_gap.resize(count), arc_gap.resize(count);
  triangle.resize(count), turn.resize(count);
}

RingTable::RingTable(const TriMesh& mesh, const AxisFrame& frame, RingTableOptions options)
    : RingTable(mesh::ClosedMesh(mesh), frame, options) {}

RingTable::RingTable(const mesh::ClosedMesh& closed, const AxisFrame& frame, RingTableOptions options)
    : frame_(frame), triangles_(closed.mesh().triangles.begin(), closed.mesh().triangles.end()) {
  const TriMesh& mesh = closed.mesh();
  const std::size_t cells = cells_for(mesh, options);
  tangential::AxisVertices vertices = tangential::vertices_in_axis_frame(mesh.vertices, frame);
  const tangential::ProfileBoxes boxes = tangential::profile_boxes(vertices.rounded, triangles_);
  scale_ = boxes.scale / vertices.units_per_mm;
  lists_ = tangential::RingLists(vertices, triangles_, boxes, cells);
  vertices_ = std::move(vertices.exact);
  free_ = free_directions_of(vertices, boxes);
}

/// Triangles with all corners in one sector are near no direction; few others are left.
tangential::FreeDirections RingTable::free_directions_of(const tangential::AxisVertices& vertices,
                                                         const tangential::ProfileBoxes& boxes) const {
  const auto& sector = vertices.sector;
  const tangential::BoxScale scale(grid(), vertices.units_per_mm);
  std::vector<tangential::FreeDirections::Directions> taken(grid().cells(), 0);
  std::array<std::vector<Index>, tangential::FreeDirections::count> near;
  std::size_t count = 0;
  for (const Index t : boxes.across_sectors) {
    const auto& [a, b, c] = triangles_[t];
    if ((sector[a] & sector[b] & sector[c]) != 0) continue;
    ++count;
    const bool clear = sector[a] != 0 && sector[b] != 0 && sector[c] != 0;
    const auto between =
        clear ? tangential::FreeDirections::between(sector[a] | sector[b] | sector[c]) : std::nullopt;
    const auto directions =
        between ? *between
                : tangential::FreeDirections::near(vertices_[a].at, vertices_[b].at, vertices_[c].at);
    if (directions == 0) continue;
    tangential::for_each_cell(
        grid(), scale.sides(boxes, t), vertices_[a].at, vertices_[b].at, vertices_[c].at,
        [&](Index row, Index column) { taken[grid().cell(row, column)] |= directions; });
    for (unsigned left = directions; left != 0; left &= left - 1)
      near[static_cast<std::size_t>(std::countr_zero(left))].push_back(t);
  }
  // In a direction free in the cell of that radius and height: of the ray outwards.
  const auto winding_along = [&](int direction, double rho, double z) {
    const double angle = tangential::FreeDirections::angle_of(direction).radians();
    const tangential::Circle circle = circle_of(Vec3(rho * std::cos(angle), rho * std::sin(angle), z));
    tangential::TangentialWork work;
    int winding = 0;
    for (const Index t : near[static_cast<std::size_t>(direction)])
      winding += tangential::outward_crossing(circle, corner_refs(t), work);
    return winding;
  };
  // Two triangles of a direction cost as much as one cell; there are as many directions as these are near to.
  return {grid(), taken, winding_along, std::max<std::size_t>(1, count / (2 * near.size()))};
}

tangential::Circle RingTable::circle_of(const Vec3& point) const noexcept {
  return {point, point.x() * point.x() + point.y() * point.y(),
          std::max({scale_, std::abs(point.x()), std::abs(point.y())})};
}

/// By the ray from the point outwards, which stays in the row of its cell, from there on. Triangles with all
/// corners on one side of it, by more than their sides are rounded (see side_of_end), do not meet it.
int RingTable::winding_outwards(const tangential::Circle& circle, const tangential::CirclePlace& place,
                                tangential::TangentialWork& work) const {
  const double doubt = 64 * core::rounding_unit * (circle.scale * circle.scale);
  const auto side = [&](const Vec3& p) { return circle.point.x() * p.y() - circle.point.y() * p.x(); };
  std::vector<std::pair<Index, int>> crossed;
  lists_.for_each_outwards(place, [&](Index t) {
    const tangential::TriangleRef corners = corner_refs(t);
    const double a = side(*corners[0]), b = side(*corners[1]), c = side(*corners[2]);
    if (std::min(std::min(a, b), c) > doubt || std::max(std::max(a, b), c) < -doubt) return;
    if (const int sense = tangential::outward_crossing(circle, corners, work)) crossed.emplace_back(t, sense);
  });
  // Listed in several cells, crossed once.
  std::sort(crossed.begin(), crossed.end());
  crossed.erase(std::unique(crossed.begin(), crossed.end()), crossed.end());
  return std::accumulate(crossed.begin(), crossed.end(), 0,
                         [](int sum, const auto& each) { return sum + each.second; });
}

/// Of a point on the axis, not on the surface: by the ray along the axis, which stays in the first column.
int RingTable::winding_on_axis(const Vec3& point) const {
  std::vector<Index> candidates;
  for (Index row = grid().row_at(point.z()); row < grid().rows; ++row) {
    for (const tangential::RingEntry& entry : lists_.of(grid().cell(row, 0)))
      candidates.push_back(entry.triangle);
  }
  std::sort(candidates.begin(), candidates.end());
  candidates.erase(std::unique(candidates.begin(), candidates.end()), candidates.end());
  return std::accumulate(candidates.begin(), candidates.end(), 0,
                         [&](int sum, Index t) { return sum + mesh::crossing_above(corners(t), point); });
}

RingTableSize RingTable::table_size() const noexcept {
  RingTableSize size{grid().cells(), lists_.entries(), 0, 0, lists_.longest(), 0, 0};
  for (std::size_t cell = 0; cell < grid().cells(); ++cell) size.cells_in_use += !lists_.of(cell).empty();
  size.bytes = lists_.bytes() + free_.bytes() + triangles_.size() * sizeof(Triangle) +
               vertices_.size() * sizeof(tangential::AxisVertex);
  if (size.cells_in_use > 0)
    size.mean_list = static_cast<double>(size.entries) / static_cast<double>(size.cells_in_use);
  if (!triangles_.empty()) {
    size.bytes_per_triangle = static_cast<double>(size.bytes) / static_cast<double>(triangles_.size());
  }
  return size;
}

}  // namespace condyle
