#include "condyle/tangential/ring_table.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <string>
#include <vector>

#include "condyle/core/error.hpp"
#include "condyle/core/predicates.hpp"
#include "condyle/mesh/vertical_ray.hpp"
#include "condyle/tangential/box_cells.hpp"

namespace condyle {
namespace {

constexpr double square(double a) noexcept {
  return a * a;
}

/// Least radius, in units of the circle's scale, at which crossings err by less than half the clearance of
/// free directions: sqrt(2 * 17u / 2^-20) < 2^-13 (see add_crossings).
constexpr double least_anchored_radius = 0x1p-20;

/// As atan2(y, x), off by at most 1.1e-5 (Abramowitz and Stegun 1964, 4.4.49): far less than the other half
/// of the clearance, and many times faster. Not for the point on the axis.
double rough_angle(double x, double y) noexcept {
  const double a = std::abs(x), b = std::abs(y), q = std::min(a, b) / std::max(a, b), s = q * q;
  double angle = q * (0.9998660 + s * (-0.3302995 + s * (0.1801410 + s * (-0.0851330 + s * 0.0208351))));
  if (b > a) angle = two_pi / 4 - angle;
  if (x < 0) angle = two_pi / 2 - angle;
  return y < 0 ? -angle : angle;
}

std::size_t cells_for(const TriMesh& mesh, const RingTableOptions& options) {
  // 64 cells per triangle is far past the point where lists stop getting shorter.
  if (!(options.cells_per_triangle > 0 && options.cells_per_triangle <= 64)) {
    throw UsageError("cells_per_triangle is " + std::to_string(options.cells_per_triangle) +
                     ", not above 0 and at most 64");
  }
  return static_cast<std::size_t>(
      std::ceil(options.cells_per_triangle * static_cast<double>(mesh.triangles.size())));
}

/// All of them, each once.
std::vector<Index> each_once(std::span<const Index> triangles, std::vector<Index> more = {}) {
  more.insert(more.end(), triangles.begin(), triangles.end());
  std::sort(more.begin(), more.end());
  more.erase(std::unique(more.begin(), more.end()), more.end());
  return more;
}

}  // namespace

void TangentialHits::resize(std::size_t count) {
  state.resize(count), winding.resize(count), angular_gap.resize(count), arc_gap.resize(count);
  triangle.resize(count), turn.resize(count);
}

RingTable::RingTable(const TriMesh& mesh, const AxisFrame& frame, RingTableOptions options)
    : RingTable(ClosedMesh(mesh), frame, options) {}

RingTable::RingTable(const ClosedMesh& closed, const AxisFrame& frame, RingTableOptions options)
    : frame_(frame), triangles_(closed.mesh().triangles.begin(), closed.mesh().triangles.end()) {
  const TriMesh& mesh = closed.mesh();
  const std::size_t cells = cells_for(mesh, options);
  AxisVertices vertices = vertices_in_axis_frame(mesh.vertices, frame);
  const ProfileBoxes boxes = profile_boxes(vertices.rounded, triangles_);
  scale_ = boxes.scale / vertices.units_per_mm;
  lists_ = RingLists(vertices, triangles_, boxes, cells);
  vertices_ = std::move(vertices.exact);
  free_ = free_directions_of(vertices, boxes);
}

/// Triangles with all corners in one sector are near no direction; few others are left.
FreeDirections RingTable::free_directions_of(const AxisVertices& vertices, const ProfileBoxes& boxes) const {
  const BoxScale scale(grid(), vertices.units_per_mm);
  std::vector<FreeDirections::Directions> taken(grid().cells(), 0);
  std::array<std::vector<Index>, FreeDirections::count> near;
  for (Index t = 0; t < triangles_.size(); ++t) {
    const auto& [a, b, c] = triangles_[t];
    const std::uint8_t in_a = vertices.sector[a], in_b = vertices.sector[b], in_c = vertices.sector[c];
    if ((in_a & in_b & in_c) != 0) continue;
    const bool clear = (in_a != 0) & (in_b != 0) & (in_c != 0);
    const auto between = clear ? FreeDirections::between(in_a | in_b | in_c) : std::nullopt;
    const auto directions =
        between ? *between : FreeDirections::near(vertices_[a].at, vertices_[b].at, vertices_[c].at);
    if (directions == 0) continue;
    const BoxSides sides = scale.sides(boxes, t);
    for (Index row = sides.first_row(); row <= sides.last_row(); ++row) {
      for (Index column = sides.first_column(); column <= sides.last_column(); ++column)
        taken[grid().cell(row, column)] |= directions;
    }
    for (unsigned left = directions; left != 0; left &= left - 1)
      near[static_cast<std::size_t>(std::countr_zero(left))].push_back(t);
  }
  // In a direction free in the cell of that radius and height: of the ray outwards.
  const auto winding_along = [&](int direction, double rho, double z) {
    const double angle = FreeDirections::angle_of(direction).radians();
    const Circle circle = circle_of(Vec3(rho * std::cos(angle), rho * std::sin(angle), z));
    TangentialWork work;
    int winding = 0;
    for (const Index t : near[static_cast<std::size_t>(direction)])
      winding += outward_crossing(circle, corner_refs(t), work);
    return winding;
  };
  return {grid(), taken, winding_along};
}

Circle RingTable::circle_of(const Vec3& point) const noexcept {
  return {point, point.x() * point.x() + point.y() * point.y(),
          std::max({scale_, std::abs(point.x()), std::abs(point.y())})};
}

/// The ray from the point outwards stays in the cell's row: every triangle it can meet is listed at this
/// column or beyond.
int RingTable::winding_outwards(const Circle& circle, std::size_t cell, TangentialWork& work) const {
  const auto candidates = each_once(lists_.outwards_from(cell));
  return std::accumulate(candidates.begin(), candidates.end(), 0, [&](int sum, Index t) {
    return sum + outward_crossing(circle, corner_refs(t), work);
  });
}

/// Of a point on the axis, not on the surface: of the ray along the axis, which stays in the first column.
int RingTable::winding_on_axis(const Vec3& point) const {
  std::vector<Index> candidates;
  for (Index row = grid().row_at(point.z()); row < grid().rows; ++row)
    candidates = each_once(lists_.of(grid().cell(row, 0)), std::move(candidates));
  return std::accumulate(candidates.begin(), candidates.end(), 0,
                         [&](int sum, Index t) { return sum + crossing_above(corners(t), point); });
}

/// From the free direction of the cell back to the point, by the crossings between them; where there is no
/// such direction, and for points on the surface, by a ray.
int RingTable::winding_ahead_of(const Circle& circle, std::size_t cell, bool on_surface,
                                std::span<const CircleCrossing> crossings, TangentialWork& work) const {
  const Vec3& p = circle.point;
  if (p.x() == 0 && p.y() == 0) return on_surface ? 0 : winding_on_axis(p);
  const auto [direction, winding_there] = free_.of(cell);
  if (on_surface || direction == FreeDirections::none ||
      circle.squared_radius < square(least_anchored_radius * circle.scale)) {
    return winding_outwards(circle, cell, work);
  }
  int winding = winding_there;
  if (crossings.empty()) return winding;
  double way = FreeDirections::angle_of(direction).radians() - rough_angle(p.x(), p.y());
  if (way < 0) way += two_pi;
  if (way > two_pi) way -= two_pi;
  for (const CircleCrossing& crossing : crossings) {
    if (crossing.ahead() >= way) break;
    winding -= static_cast<int>(crossing.passage);
  }
  return winding;
}

RingTableSize RingTable::table_size() const noexcept {
  RingTableSize size{grid().cells(), lists_.entries(), 0, 0, lists_.longest(), 0, 0};
  for (std::size_t cell = 0; cell < grid().cells(); ++cell) size.cells_in_use += !lists_.of(cell).empty();
  size.bytes =
      lists_.bytes() + free_.bytes() + triangles_.size() * sizeof(Triangle) + vertices_.size() * sizeof(AxisVertex);
  if (size.cells_in_use > 0)
    size.mean_list = static_cast<double>(size.entries) / static_cast<double>(size.cells_in_use);
  if (!triangles_.empty()) {
    size.bytes_per_triangle = static_cast<double>(size.bytes) / static_cast<double>(triangles_.size());
  }
  return size;
}

}  // namespace condyle
