#include <algorithm>
#include <cmath>
#include <mutex>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "condyle/error.hpp"
#include "condyle/tangential.hpp"
#include "core/coordinate_range.hpp"
#include "core/parallel.hpp"
#include "mesh/edge_balance.hpp"
#include "tangential/build/rings.hpp"
#include "tangential/query/answers.hpp"
#include "tangential/query/circle_batch.hpp"

namespace condyle::tangential {
namespace {

using tangential::CircleBatch;

void require_closed(const Mesh& mesh) {
  if (const auto& edge = mesh.unbalanced_edge()) mesh::refuse_unbalanced(*edge);
}

std::size_t cell_count(const Mesh& mesh, const RingTableOptions& options) {
  // 64 cells per triangle is far past the point where lists stop getting shorter.
  if (!(options.cells_per_triangle > 0 && options.cells_per_triangle <= 64)) {
    throw UsageError("cells_per_triangle is " + std::to_string(options.cells_per_triangle) +
                     ", not above 0 and at most 64");
  }
  return static_cast<std::size_t>(
      std::ceil(options.cells_per_triangle * static_cast<double>(mesh.triangles().size())));
}

/// In the order of the batches, whichever threads found them: the same bytes for any number of threads.
std::vector<OccupiedArc> joined(const std::vector<std::vector<OccupiedArc>>& batches) {
  std::vector<OccupiedArc> all;
  all.reserve(std::accumulate(batches.begin(), batches.end(), std::size_t{0},
                              [](std::size_t sum, const auto& arcs) { return sum + arcs.size(); }));
  for (const auto& arcs : batches) all.insert(all.end(), arcs.begin(), arcs.end());
  return all;
}

}  // namespace

TangentialWork& TangentialWork::operator+=(const TangentialWork& other) noexcept {
  points += other.points, candidates += other.candidates, evaluated += other.evaluated;
  crossings += other.crossings, exact_decisions += other.exact_decisions;
  return *this;
}

void TangentialResults::resize(std::size_t count) {
  state.resize(count), winding.resize(count), angular_gap.resize(count), arc_gap_mm.resize(count);
  triangle.resize(count), rotation_sense.resize(count);
}

RingTable::RingTable(const Mesh& mesh, const AxisFrame& frame, RingTableOptions options) {
  require_closed(mesh);
  const std::size_t cells = cell_count(mesh, options);
  rings_ = std::make_shared<const Rings>(tangential::build_rings(mesh, frame, cells));
}

void RingTable::query(PointsView points, TangentialResults& results, TangentialRule rule) const {
  core::require_in_range(points);
  results.resize(points.size());
  results.work = {};
  std::mutex adding;
  core::parallel_chunks(points.size(), CircleBatch::most, [&](std::size_t first, std::size_t last) {
    CircleBatch batch(*rings_);
    for (std::size_t begin = first; begin < last; begin += CircleBatch::most) {
      const std::size_t end = std::min(last, begin + CircleBatch::most);
      batch.find_crossings(points.subspan(begin, end - begin));
      write_results(batch, *rings_, begin, end, rule, results);
    }
    const std::scoped_lock lock(adding);
    results.work += batch.work();
  });
}

TangentialResults RingTable::query(PointsView points, TangentialRule rule) const {
  TangentialResults results;
  query(points, results, rule);
  return results;
}

OccupiedArcs RingTable::occupied_arcs(PointsView points) const {
  core::require_in_range(points);
  const std::size_t batches = (points.size() + CircleBatch::most - 1) / CircleBatch::most;
  std::vector<std::vector<OccupiedArc>> arcs(batches);
  // Until they are summed, the number of arcs of each point, one to the right.
  std::vector<std::size_t> offset(points.size() + 1, 0);
  core::parallel_chunks(batches, 1, [&](std::size_t first, std::size_t last) {
    CircleBatch batch(*rings_);
    for (std::size_t b = first; b < last; ++b) {
      const std::size_t begin = b * CircleBatch::most,
                        end = std::min(points.size(), begin + CircleBatch::most);
      batch.find_crossings(points.subspan(begin, end - begin));
      append_arcs(batch, offset.data() + 1 + begin, arcs[b]);
    }
  });
  std::partial_sum(offset.begin(), offset.end(), offset.begin());
  return {std::move(offset), joined(arcs)};
}

const AxisFrame& RingTable::frame() const noexcept {
  return rings_->frame;
}

RingTableSize RingTable::table_size() const noexcept {
  return size_of(*rings_);
}

}  // namespace condyle::tangential
