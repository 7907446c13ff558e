#include "tangential/query/winding.hpp"

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

#include "core/predicates.hpp"
#include "mesh/vertical_ray.hpp"

namespace condyle::tangential {
namespace {

/// visit(triangle) for those whose boxes reach the circle's height in its cell or further out in its row, some
/// more than once.
template <class Visit>
void for_each_outwards(const RingLists& lists, const CircleCell& circle, const Visit& visit) {
  const std::size_t columns = lists.grid().columns, row_end = (circle.cell / columns + 1) * columns;
  const Index* const offsets = lists.offsets();
  for (Index i = offsets[circle.cell]; i < offsets[row_end]; ++i) {
    const auto [triangle, box] = lists.entry_data()[i];
    const bool above = (box & 0xff) <= (circle.bytes & 0xff);
    const bool below = (box >> 8 & 0xff) <= (circle.bytes >> 8 & 0xff);
    if (above & below) visit(triangle);
  }
}

}  // namespace

/// The ray stays in the row of its cell, from there on. Triangles with all corners on one side of it, by more
/// than their sides are rounded (see side_of_end), do not meet it.
int winding_outwards(const Rings& rings, const Circle& circle, const CircleCell& cell, TangentialWork& work) {
  const double uncertain = 64 * core::rounding_unit * (circle.scale * circle.scale);
  const auto side = [&](const Vec3& p) { return circle.point.x() * p.y() - circle.point.y() * p.x(); };
  std::vector<std::pair<Index, int>> crossed;
  for_each_outwards(rings.lists, cell, [&](Index t) {
    const TriangleRef corners = rings.corner_refs(t);
    const double a = side(*corners[0]), b = side(*corners[1]), c = side(*corners[2]);
    if (std::min(std::min(a, b), c) > uncertain || std::max(std::max(a, b), c) < -uncertain) return;
    if (const int sign = outward_crossing(circle, corners, work)) crossed.emplace_back(t, sign);
  });
  // Entered in several cells, crossed once.
  std::sort(crossed.begin(), crossed.end());
  crossed.erase(std::unique(crossed.begin(), crossed.end()), crossed.end());
  return std::accumulate(crossed.begin(), crossed.end(), 0,
                         [](int sum, const auto& each) { return sum + each.second; });
}

/// The ray stays in the first column.
int winding_on_axis(const Rings& rings, const Vec3& point) {
  const ProfileGrid& grid = rings.grid();
  std::vector<Index> candidates;
  for (Index row = grid.row_at(point.z()); row < grid.rows; ++row) {
    for (const RingEntry& entry : rings.lists.of(grid.cell(row, 0))) candidates.push_back(entry.triangle);
  }
  std::sort(candidates.begin(), candidates.end());
  candidates.erase(std::unique(candidates.begin(), candidates.end()), candidates.end());
  return std::accumulate(candidates.begin(), candidates.end(), 0, [&](int sum, Index t) {
    return sum + mesh::crossing_above(rings.corners(t), point);
  });
}

}  // namespace condyle::tangential
