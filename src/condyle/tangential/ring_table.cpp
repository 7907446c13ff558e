#include "condyle/tangential/ring_table.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <mutex>
#include <numeric>
#include <string>

#include "condyle/core/error.hpp"
#include "condyle/core/parallel.hpp"
#include "condyle/core/predicates.hpp"

namespace condyle {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Points per task: enough to outweigh starting one.
constexpr std::size_t points_per_chunk = 256;

constexpr int unknown_winding = std::numeric_limits<int>::min();

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
  PointWinding at_point;
  int winding = 0;  ///< Just ahead of the point.
  std::vector<CircleCrossing> crossings;
  std::vector<Index> row;
  TangentialWork work;
};

void TangentialHits::resize(std::size_t count) {
  state.resize(count), winding.resize(count), angular_gap.resize(count), arc_gap.resize(count);
  triangle.resize(count), turn.resize(count);
}

RingTable::RingTable(const TriMesh& mesh, const AxisFrame& frame, RingTableOptions options)
    : frame_(frame),
      winding_(frame.to_axis(mesh)),
      grid_(ProfileGrid::over(winding_.mesh(), cells_for(mesh, options))) {
  for (const auto& triangle : this->mesh().triangles) {
    for (const Index v : triangle) {
      const Vec3 p = this->mesh().vertices[v];
      scale_ = std::max({scale_, std::abs(p.x()), std::abs(p.y())});
    }
  }
  fill();
  find_empty_cells();
}

void RingTable::fill() {
  offset_.assign(grid_.cells() + 1, 0);
  const auto for_each_cell = [&](Index triangle, const auto& visit) {
    const auto [a, b, c] = corners(triangle);
    for_each_profile_run(grid_, a, b, c, [&](Index row, Index first, Index last) {
      for (Index column = first; column <= last; ++column) visit(grid_.cell(row, column));
    });
  };
  const auto count = static_cast<Index>(mesh().triangles.size());
  for (Index t = 0; t < count; ++t) for_each_cell(t, [&](std::size_t cell) { ++offset_[cell + 1]; });
  for (std::size_t cell = 1; cell < offset_.size(); ++cell) offset_[cell] += offset_[cell - 1];
  triangle_.resize(offset_.back());
  std::vector<Index> next(offset_.begin(), offset_.end() - 1);
  for (Index t = 0; t < count; ++t) for_each_cell(t, [&](std::size_t cell) { triangle_[next[cell]++] = t; });
}

/// Neighbouring empty cells of a row are one piece of space without surface: one winding number each run.
void RingTable::find_empty_cells() {
  cell_winding_.assign(grid_.cells(), unknown_winding);
  constexpr std::size_t rows_per_chunk = 8;
  parallel_chunks(grid_.rows, rows_per_chunk, [&](std::size_t first, std::size_t last) {
    for (auto row = static_cast<Index>(first); row < last; ++row) {
      int winding = unknown_winding;
      for (Index column = 0; column < grid_.columns; ++column) {
        const std::size_t cell = grid_.cell(row, column);
        if (!triangles_in(cell).empty()) {
          winding = unknown_winding;
          continue;
        }
        if (winding == unknown_winding) {
          const Vec3 middle(grid_.rho_min + (column + 0.5) * grid_.rho_cell, 0,
                            grid_.z_min + (row + 0.5) * grid_.z_cell);
          // In cells as narrow as rounding the middle may fall beside: such a cell stays unknown.
          if (grid_.cell_of(axis_radius(middle.x(), 0), middle.z()) == cell)
            winding = winding_.at(middle).winding;
        }
        cell_winding_[cell] = winding;
      }
    }
  });
}

Circle RingTable::circle_of(const Vec3& point) const noexcept {
  return {point, point.x() * point.x() + point.y() * point.y(),
          std::max({scale_, std::abs(point.x()), std::abs(point.y())})};
}

/// The ray from the point outwards stays in the cell's row: every triangle it can meet is listed at this
/// column or beyond.
int RingTable::winding_ahead_of(const Circle& circle, Index row, Index column, Scratch& scratch) const {
  scratch.row.assign(triangle_.begin() + offset_[grid_.cell(row, column)],
                     triangle_.begin() + offset_[grid_.cell(row, grid_.columns - 1) + 1]);
  std::sort(scratch.row.begin(), scratch.row.end());
  scratch.row.erase(std::unique(scratch.row.begin(), scratch.row.end()), scratch.row.end());
  int winding = 0;
  for (const Index t : scratch.row) winding += outward_crossing(circle, corners(t), scratch.work);
  return winding;
}

/// The sorted crossings of the point's circle.
void RingTable::collect_crossings(const Vec3& point, Scratch& scratch) const {
  scratch.crossings.clear();
  const Circle circle = circle_of(point);
  const auto cell = grid_.cell_of(axis_radius(point.x(), point.y()), point.z());
  if (!cell || (point.x() == 0 && point.y() == 0)) return;
  const auto candidates = triangles_in(*cell);
  scratch.work.candidates += candidates.size();
  for (const Index t : candidates) add_crossings(circle, corners(t), t, scratch.crossings, scratch.work);
  std::sort(scratch.crossings.begin(), scratch.crossings.end());
  assert(std::accumulate(scratch.crossings.begin(), scratch.crossings.end(), 0,
                         [](int sum, const auto& c) { return sum + static_cast<int>(c.passage); }) == 0);
}

/// Crossings of the point's circle, exact state of the point, and the winding number just ahead of it.
void RingTable::survey(const Vec3& point, Scratch& scratch) const {
  ++scratch.work.points;
  scratch.crossings.clear();
  scratch.at_point = {};
  scratch.winding = 0;
  const double rho = axis_radius(point.x(), point.y());
  const auto cell = grid_.cell_of(rho, point.z());
  // No surface has that radius and height: the ring about the axis reaches out of everything.
  if (!cell) return;
  if (cell_winding_[*cell] != unknown_winding) {
    scratch.winding = cell_winding_[*cell];
    scratch.at_point = {scratch.winding > 0 ? PointState::inside : PointState::outside, scratch.winding,
                        no_index};
    return;
  }
  collect_crossings(point, scratch);
  scratch.at_point = winding_.at(point);
  scratch.winding = scratch.at_point.winding;
  if (scratch.at_point.state == PointState::on_surface && (point.x() != 0 || point.y() != 0)) {
    scratch.winding =
        winding_ahead_of(circle_of(point), grid_.row_at(point.z()), grid_.column_at(rho), scratch);
  }
}

void RingTable::answer_alternating(std::size_t i, const Vec3& point, Scratch& scratch,
                                   TangentialHits& out) const {
  survey(point, scratch);
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

void RingTable::answer_nearest_arc(std::size_t i, const Vec3& point, Scratch& scratch,
                                   TangentialHits& out) const {
  ++scratch.work.points;
  collect_crossings(point, scratch);
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
    for (std::size_t i = first; i < last; ++i) {
      const Vec3 point = frame_.to_axis(points[i]);
      if (rule == TangentialRule::alternating) {
        answer_alternating(i, point, scratch, out);
      } else {
        answer_nearest_arc(i, point, scratch, out);
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
      const std::size_t end = std::min(points.size(), (chunk + 1) * points_per_chunk);
      for (std::size_t i = chunk * points_per_chunk; i < end; ++i) {
        survey(frame_.to_axis(points[i]), scratch);
        append_arcs(scratch.winding, scratch.crossings, arcs[chunk]);
        offset[i + 1] = arcs[chunk].size();
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
  size.bytes = (offset_.size() + triangle_.size()) * sizeof(Index) + cell_winding_.size() * sizeof(int) +
               winding_.bytes();
  if (size.cells_in_use > 0)
    size.mean_list = static_cast<double>(size.entries) / static_cast<double>(size.cells_in_use);
  if (!mesh().triangles.empty()) {
    size.bytes_per_triangle = static_cast<double>(size.bytes) / static_cast<double>(mesh().triangles.size());
  }
  return size;
}

}  // namespace condyle
