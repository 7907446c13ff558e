#include "condyle/tangential/ring_table.hpp"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <limits>
#include <mutex>
#include <numeric>
#include <string>

#include "condyle/core/error.hpp"
#include "condyle/core/parallel.hpp"
#include "condyle/core/predicates.hpp"
#include "condyle/mesh/vertical_ray.hpp"
#include "condyle/tangential/circle_filter.hpp"

namespace condyle {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

constexpr double square(double a) noexcept {
  return a * a;
}

/// Points per task: enough to outweigh starting one.
constexpr std::size_t points_per_chunk = 256;

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

}  // namespace

/// What one chunk of points reuses, so that a point allocates nothing.
struct RingTable::Scratch {
  /// The points of the chunk, in the axis frame, and the cells of their circles.
  struct Placed {
    Vec3 point;
    Index cell;  ///< no_index beyond the grid
  };
  std::vector<Placed> placed;
  /// Those cells that list triangles, in the order of the points.
  std::vector<Index> lists;
  std::size_t lists_done = 0;
  CircleFilter filter;
  /// Of the point at hand:
  PointWinding at_point;
  int winding = 0;  ///< Just ahead of the point.
  std::vector<CircleCrossing> crossings;
  Index holding = no_index;  ///< A triangle that holds the point.
  TangentialWork work;
};

void TangentialHits::resize(std::size_t count) {
  state.resize(count), winding.resize(count), angular_gap.resize(count), arc_gap.resize(count);
  triangle.resize(count), turn.resize(count);
}

RingTable::RingTable(const TriMesh& mesh, const AxisFrame& frame, RingTableOptions options)
    : RingTable(ClosedMesh(mesh), frame, options) {}

RingTable::RingTable(const ClosedMesh& closed, const AxisFrame& frame, RingTableOptions options)
    : frame_(frame), vertices_(closed.mesh().vertices.size()), triangles_(closed.mesh().triangles) {
  const TriMesh& mesh = closed.mesh();
  for (std::size_t v = 0; v < vertices_.size(); ++v) vertices_[v] = frame.to_axis(mesh.vertices[v]);
  for (const Triangle& triangle : triangles_) {
    for (const Index v : triangle)
      scale_ = std::max({scale_, std::abs(vertices_[v].x()), std::abs(vertices_[v].y())});
  }
  grid_ = ProfileGrid::over(vertices_, triangles_, cells_for(mesh, options));
  list_triangles();
}

void RingTable::list_triangles() {
  struct Run {
    Index first_cell, end_cell, triangle;
  };
  std::vector<Run> runs;
  runs.reserve(3 * triangles_.size());
  offset_.assign(grid_.cells() + 1, 0);
  for (Index t = 0; t < triangles_.size(); ++t) {
    const auto& [a, b, c] = triangles_[t];
    for_each_profile_run(grid_, vertices_[a], vertices_[b], vertices_[c],
                         [&](Index row, Index first, Index last) {
                           const auto begin = static_cast<Index>(grid_.cell(row, first));
                           const Index end = begin + (last - first) + 1;
                           runs.push_back({begin, end, t});
                           // How many more triangles the cell has than the one before it.
                           ++offset_[begin], --offset_[end];
                         });
  }
  Index length = 0, sum = 0;
  for (Index& offset : offset_) {
    length += offset;
    offset = sum += length;
  }
  triangle_.resize(offset_.back());
  near_.resize(triangles_.size());
  for (Index t = 0; t < triangles_.size(); ++t) {
    const auto& [a, b, c] = triangles_[t];
    near_[t] = FreeDirections::near(vertices_[a], vertices_[b], vertices_[c]);
  }
  std::vector<FreeDirections::Directions> taken(grid_.cells(), 0);
  // From the last run to the first, each list from its end: offsets, which began at the ends, come to stand
  // at the beginnings.
  for (auto run = runs.rbegin(); run != runs.rend(); ++run) {
    for (Index cell = run->first_cell; cell < run->end_cell; ++cell)
      triangle_[--offset_[cell]] = run->triangle;
    const FreeDirections::Directions near = near_[run->triangle];
    for (Index cell = run->first_cell; near != 0 && cell < run->end_cell; ++cell) taken[cell] |= near;
  }
  free_ = FreeDirections(
      grid_, taken, [&](int direction, double rho, double z) { return winding_along(direction, rho, z); });
}

/// In a direction free in the cell of that radius and height: of the ray outwards.
int RingTable::winding_along(int direction, double rho, double z) const {
  const double angle = FreeDirections::angle_of(direction).radians();
  const Vec3 point(rho * std::cos(angle), rho * std::sin(angle), z);
  TangentialWork work;
  return winding_outwards(
      circle_of(point), grid_.cell(grid_.row_at(z), grid_.column_at(rho)),
      [&](Index t) { return (near_[t] >> direction & 1) != 0; }, work);
}

Circle RingTable::circle_of(const Vec3& point) const noexcept {
  return {point, point.x() * point.x() + point.y() * point.y(),
          std::max({scale_, std::abs(point.x()), std::abs(point.y())})};
}

/// The ray from the point outwards stays in the cell's row: every triangle it can meet is listed at this
/// column or beyond. Asked of those that `keep` keeps.
template <class Keep>
int RingTable::winding_outwards(const Circle& circle, std::size_t cell, const Keep& keep,
                                TangentialWork& work) const {
  const std::size_t row_end = (cell / grid_.columns + 1) * grid_.columns;
  std::vector<std::pair<Index, int>> crossed;
  for (Index i = offset_[cell]; i < offset_[row_end]; ++i) {
    const Index t = triangle_[i];
    if (!keep(t)) continue;
    if (const int sense = outward_crossing(circle, corner_refs(t), work)) crossed.emplace_back(t, sense);
  }
  // Listed in several cells, crossed once.
  std::sort(crossed.begin(), crossed.end());
  crossed.erase(std::unique(crossed.begin(), crossed.end()), crossed.end());
  return std::accumulate(crossed.begin(), crossed.end(), 0,
                         [](int sum, const auto& each) { return sum + each.second; });
}

/// Of a point on the axis, not on the surface: of the ray along the axis, which stays in the first column.
int RingTable::winding_on_axis(const Vec3& point) const {
  std::vector<Index> candidates;
  for (Index row = grid_.row_at(point.z()); row < grid_.rows; ++row) {
    const auto listed = triangles_in(grid_.cell(row, 0));
    candidates.insert(candidates.end(), listed.begin(), listed.end());
  }
  std::sort(candidates.begin(), candidates.end());
  candidates.erase(std::unique(candidates.begin(), candidates.end()), candidates.end());
  return std::accumulate(candidates.begin(), candidates.end(), 0,
                         [&](int sum, Index t) { return sum + crossing_above(corners(t), point); });
}

/// The sorted crossings of the point's circle, and the first triangle that holds the point.
void RingTable::collect_crossings(const Circle& circle, std::size_t cell, Scratch& scratch) const {
  scratch.crossings.clear();
  scratch.holding = no_index;
  fetch_ahead(scratch);
  const Vec3& p = circle.point;
  const auto candidates = triangles_in(cell);
  scratch.work.candidates += candidates.size();
  const bool turns = p.x() != 0 || p.y() != 0;
  CircleFilter& filter = scratch.filter;
  filter.begin(circle);
  for (std::size_t first = 0; first < candidates.size(); first += CircleFilter::width) {
    const auto some = candidates.subspan(first, std::min(CircleFilter::width, candidates.size() - first));
    for (std::size_t i = 0; i < some.size(); ++i) filter.put(i, corner_refs(some[i]));
    const auto verdict = filter.judge(some.size());
    for (unsigned left = turns ? verdict.may_cross : 0; left != 0; left &= left - 1) {
      const Index t = some[static_cast<std::size_t>(std::countr_zero(left))];
      add_crossings(circle, corner_refs(t), t, scratch.crossings, scratch.work);
    }
    if (turns) scratch.work.cut += static_cast<std::size_t>(std::popcount(verdict.cut & ~verdict.may_cross));
    // Most of a ring is far off: seldom is a point near a triangle.
    for (unsigned left = verdict.may_hold; left != 0; left &= left - 1) {
      const Index t = some[static_cast<std::size_t>(std::countr_zero(left))];
      const auto [a, b, c] = corner_refs(t);
      if (scratch.holding == no_index && orientation(*a, *b, *c, p) == Sign::zero &&
          contains_coplanar(corners(t), p))
        scratch.holding = t;
    }
  }
  std::sort(scratch.crossings.begin(), scratch.crossings.end());
  assert(std::accumulate(scratch.crossings.begin(), scratch.crossings.end(), 0,
                         [](int sum, const auto& c) { return sum + static_cast<int>(c.passage); }) == 0);
}

/// From the free direction of the cell back to the point, by the crossings between them; where there is no
/// such direction, and for points on the surface, by a ray.
int RingTable::winding_ahead_of(const Circle& circle, std::size_t cell, bool on_surface,
                                Scratch& scratch) const {
  const Vec3& p = circle.point;
  if (p.x() == 0 && p.y() == 0) return on_surface ? 0 : winding_on_axis(p);
  const auto [direction, winding_there] = free_.of(cell);
  if (on_surface || direction == FreeDirections::none ||
      circle.squared_radius < square(least_anchored_radius * circle.scale)) {
    return winding_outwards(
        circle, cell, [](Index) { return true; }, scratch.work);
  }
  int winding = winding_there;
  if (scratch.crossings.empty()) return winding;
  double way = FreeDirections::angle_of(direction).radians() - rough_angle(p.x(), p.y());
  if (way < 0) way += two_pi;
  if (way > two_pi) way -= two_pi;
  for (const CircleCrossing& crossing : scratch.crossings) {
    if (crossing.ahead() >= way) break;
    winding -= static_cast<int>(crossing.passage);
  }
  return winding;
}

/// All points first: the processor then fetches what their cells hold while it computes the next.
void RingTable::place(PointsView points, Scratch& scratch) const {
  scratch.placed.resize(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec3 point = frame_.to_axis(points[i]);
    const auto cell = grid_.cell_of(axis_radius(point.x(), point.y()), point.z());
    scratch.placed[i] = {point, cell ? static_cast<Index>(*cell) : no_index};
    if (!cell) continue;
    __builtin_prefetch(&offset_[*cell]);
    free_.fetch(*cell);
  }
  scratch.lists.clear();
  scratch.lists_done = 0;
  for (const auto& [point, cell] : scratch.placed) {
    if (cell == no_index || triangles_in(cell).empty()) continue;
    __builtin_prefetch(triangle_.data() + offset_[cell]);
    scratch.lists.push_back(cell);
  }
}

/// Asks memory for what the next lists lead to: their triangles, and of nearer ones the vertices. Without it
/// the processor waits for memory most of the time.
void RingTable::fetch_ahead(Scratch& scratch) const noexcept {
  constexpr std::size_t triangles_ahead = 8, vertices_ahead = 4;
  const std::size_t at = scratch.lists_done++;
  if (at + triangles_ahead < scratch.lists.size()) {
    for (const Index t : triangles_in(scratch.lists[at + triangles_ahead]))
      __builtin_prefetch(&triangles_[t]);
  }
  if (at + vertices_ahead < scratch.lists.size()) {
    for (const Index t : triangles_in(scratch.lists[at + vertices_ahead])) {
      for (const Index v : triangles_[t]) __builtin_prefetch(&vertices_[v]);
    }
  }
}

/// Crossings of the point's circle, exact state of the point, and the winding number just ahead of it.
void RingTable::survey(std::size_t i, Scratch& scratch) const {
  const auto& [point, cell] = scratch.placed[i];
  ++scratch.work.points;
  scratch.crossings.clear();
  scratch.at_point = {};
  scratch.winding = 0;
  // No surface has that radius and height: the ring about the axis reaches out of everything.
  if (cell == no_index) return;
  if (triangles_in(cell).empty()) {
    // No surface in the whole ring: one winding number.
    const auto anchor = free_.of(cell);
    if (anchor.direction != FreeDirections::none) {
      scratch.winding = anchor.winding;
      scratch.at_point = {scratch.winding > 0 ? PointState::inside : PointState::outside, scratch.winding,
                          no_index};
      return;
    }
  }
  const Circle circle = circle_of(point);
  collect_crossings(circle, cell, scratch);
  const bool on_surface = scratch.holding != no_index;
  scratch.winding = winding_ahead_of(circle, cell, on_surface, scratch);
  scratch.at_point = on_surface ? PointWinding{PointState::on_surface, 0, scratch.holding}
                                : PointWinding{scratch.winding > 0 ? PointState::inside : PointState::outside,
                                               scratch.winding, no_index};
}

void RingTable::answer_alternating(std::size_t at, Scratch& scratch, TangentialHits& out,
                                   std::size_t i) const {
  survey(at, scratch);
  const Vec3& point = scratch.placed[at].point;
  out.state[i] = scratch.at_point.state;
  out.winding[i] = scratch.winding;
  if (scratch.at_point.state == PointState::on_surface) {
    out.angular_gap[i] = out.arc_gap[i] = 0;
    out.triangle[i] = scratch.at_point.triangle;
    out.turn[i] = Turn::none;
    return;
  }
  const AngularGap gap = gap_at_point(scratch.winding, scratch.crossings);
  out.angular_gap[i] = gap.angle;
  // On the axis the gap is infinite, its length too.
  out.arc_gap[i] = std::isinf(gap.angle) ? gap.angle : gap.angle * axis_radius(point.x(), point.y());
  out.triangle[i] = gap.triangle;
  out.turn[i] = gap.turn;
}

void RingTable::answer_nearest_arc(std::size_t at, Scratch& scratch, TangentialHits& out,
                                   std::size_t i) const {
  const auto& [point, cell] = scratch.placed[at];
  ++scratch.work.points;
  scratch.crossings.clear();
  if (cell != no_index) collect_crossings(circle_of(point), cell, scratch);
  out.state[i] = PointState::outside, out.winding[i] = 0;
  out.angular_gap[i] = out.arc_gap[i] = infinity, out.triangle[i] = no_index, out.turn[i] = Turn::none;
  const auto& crossings = scratch.crossings;
  if (crossings.empty()) return;
  const auto nearest = std::min_element(crossings.begin(), crossings.end(), [](const auto& a, const auto& b) {
    return std::abs(a.angle) < std::abs(b.angle);
  });
  const auto [a, b, c] = corners(nearest->triangle);
  const Sign side = orientation(a, b, c, point);
  out.state[i] = side == Sign::negative ? PointState::inside
                 : side == Sign::zero   ? PointState::on_surface
                                        : PointState::outside;
  out.winding[i] = side == Sign::negative ? 1 : 0;
  out.angular_gap[i] = static_cast<int>(side) * std::abs(nearest->angle);
  out.arc_gap[i] = out.angular_gap[i] * axis_radius(point.x(), point.y());
  out.triangle[i] = nearest->triangle;
  if (side != Sign::zero) out.turn[i] = nearest->angle > 0 ? Turn::positive : Turn::negative;
}

void RingTable::query(PointsView points, TangentialHits& out, TangentialRule rule) const {
  out.resize(points.size());
  out.work = {};
  std::mutex adding;
  parallel_chunks(points.size(), points_per_chunk, [&](std::size_t first, std::size_t last) {
    Scratch scratch;
    place(points.subspan(first, last - first), scratch);
    for (std::size_t i = first; i < last; ++i) {
      if (rule == TangentialRule::alternating) {
        answer_alternating(i - first, scratch, out, i);
      } else {
        answer_nearest_arc(i - first, scratch, out, i);
      }
    }
    const std::scoped_lock lock(adding);
    out.work += scratch.work;
  });
}

TangentialHits RingTable::query(PointsView points, TangentialRule rule) const {
  TangentialHits out;
  query(points, out, rule);
  return out;
}

OccupiedArcs RingTable::occupied_arcs(PointsView points) const {
  // Chunks of a fixed size, joined in their order: the same bytes for any number of threads.
  const std::size_t chunks = (points.size() + points_per_chunk - 1) / points_per_chunk;
  std::vector<std::vector<OccupiedArc>> arcs(chunks);
  std::vector<std::size_t> offset(points.size() + 1, 0);
  parallel_chunks(chunks, 1, [&](std::size_t first, std::size_t last) {
    Scratch scratch;
    for (std::size_t chunk = first; chunk < last; ++chunk) {
      const std::size_t begin = chunk * points_per_chunk;
      place(points.subspan(begin, std::min(points_per_chunk, points.size() - begin)), scratch);
      for (std::size_t i = 0; i < scratch.placed.size(); ++i) {
        survey(i, scratch);
        append_arcs(scratch.winding, scratch.crossings, arcs[chunk]);
        offset[begin + i + 1] = arcs[chunk].size();
      }
    }
  });
  std::vector<OccupiedArc> all;
  for (std::size_t chunk = 0; chunk < chunks; ++chunk) {
    const std::size_t end = std::min(points.size(), (chunk + 1) * points_per_chunk);
    for (std::size_t i = chunk * points_per_chunk; i < end; ++i) offset[i + 1] += all.size();
    all.insert(all.end(), arcs[chunk].begin(), arcs[chunk].end());
  }
  return {std::move(offset), std::move(all)};
}

RingTableSize RingTable::table_size() const noexcept {
  RingTableSize size{grid_.cells(), triangle_.size(), 0, 0, 0, 0, 0};
  for (std::size_t cell = 0; cell < grid_.cells(); ++cell) {
    const std::size_t length = triangles_in(cell).size();
    size.cells_in_use += length > 0;
    size.longest_list = std::max(size.longest_list, length);
  }
  size.bytes = (offset_.size() + triangle_.size()) * sizeof(Index) + free_.bytes() +
               near_.size() * sizeof(FreeDirections::Directions) + triangles_.size() * sizeof(Triangle) +
               vertices_.size() * sizeof(Vec3);
  if (size.cells_in_use > 0)
    size.mean_list = static_cast<double>(size.entries) / static_cast<double>(size.cells_in_use);
  if (!triangles_.empty()) {
    size.bytes_per_triangle = static_cast<double>(size.bytes) / static_cast<double>(triangles_.size());
  }
  return size;
}

}  // namespace condyle
