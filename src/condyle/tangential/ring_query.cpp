#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <mutex>
#include <numeric>

#include "condyle/core/parallel.hpp"
#include "condyle/tangential/circle_cuts.hpp"
#include "condyle/tangential/ring_table.hpp"

namespace condyle {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Points taken together: enough that the processor always has memory to wait for, few enough that all about
/// them stays in its first cache.
constexpr std::size_t points_per_chunk = 256;

/// Few, nearly always: two to six.
void sort_few(std::span<CircleCrossing> crossings) noexcept {
  for (std::size_t i = 1; i < crossings.size(); ++i) {
    const CircleCrossing moved = crossings[i];
    std::size_t at = i;
    for (; at > 0 && moved < crossings[at - 1]; --at) crossings[at] = crossings[at - 1];
    crossings[at] = moved;
  }
}

}  // namespace

/// Some points, their circles and where these cross the surface. Reused from chunk to chunk, so that points
/// allocate nothing.
class RingTable::Chunk {
 public:
  explicit Chunk(const RingTable& table) : table_(table), cuts_(table.scale_) {}

  /// Finds all crossings of the circles of these points.
  void cross(PointsView points);

  /// What is known of one point.
  struct Survey {
    const Vec3& point;
    PointState state;
    int winding;     ///< Just ahead of the point.
    Index triangle;  ///< One that holds the point.
    std::span<const CircleCrossing> crossings;
  };
  Survey survey(std::size_t i);
  /// Without state and winding number.
  std::span<const CircleCrossing> crossings_of(std::size_t i) noexcept;
  const Vec3& point(std::size_t i) const noexcept { return point_[i]; }

  const TangentialWork& work() const noexcept { return work_; }

 private:
  void place(PointsView points);
  void decide();
  void decide_exactly(std::size_t i, Index triangle);
  void take_verdicts();

  const RingTable& table_;
  /// In the axis frame, and the cells of their circles: no_index beyond the grid.
  std::array<Vec3, points_per_chunk> point_;
  std::array<Index, points_per_chunk> cell_;
  /// Circles within the grid, and the numbers of their points.
  std::vector<CirclePlace> circle_;
  std::vector<Index> point_of_circle_;
  CirclePairs pairs_;
  CircleCuts cuts_;
  /// Of the cuts.
  std::array<Index, CutColumns::most> cut_point_, cut_triangle_;
  /// Crossings of point i are [end_[i - 1], end_[i]).
  UninitialisedVector<CircleCrossing> crossing_;
  std::size_t crossings_ = 0;
  std::vector<CircleCrossing> exact_;
  std::array<std::size_t, points_per_chunk> end_;
  std::array<Index, points_per_chunk> holding_;  ///< A triangle that holds the point.
  TangentialWork work_;
};

void RingTable::Chunk::place(PointsView points) {
  circle_.clear(), point_of_circle_.clear();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec3 point = table_.frame_.to_axis(points[i]);
    point_[i] = point;
    const auto place = table_.lists_.place(axis_radius(point.x(), point.y()), point.z());
    cell_[i] = place ? place->cell : no_index;
    holding_[i] = no_index;
    if (!place) continue;
    table_.lists_.fetch_offset(place->cell), table_.free_.fetch(place->cell);
    circle_.push_back(*place), point_of_circle_.push_back(static_cast<Index>(i));
  }
  for (const CirclePlace& circle : circle_) {
    table_.lists_.fetch_list(circle.cell);
    work_.candidates += table_.lists_.of(circle.cell).size();
  }
  work_.points += points.size();
}

void RingTable::Chunk::cross(PointsView points) {
  place(points);
  crossings_ = 0;
  end_.fill(0);
  for (std::size_t done = 0; done < circle_.size();) {
    done = table_.lists_.find(circle_, done, pairs_);
    decide();
  }
  for (std::size_t i = 0, end = 0; i < points.size(); ++i) end_[i] = end = std::max(end, end_[i]);
  work_.crossings += crossings_;
}

/// Asks memory for triangles and corners some pairs before they are looked at: without it the processor waits
/// for memory most of the time.
void RingTable::Chunk::decide() {
  constexpr std::size_t triangles_ahead = 32, corners_ahead = 16;
  const std::span<const Index> triangles = pairs_.triangle;
  for (std::size_t k = 0; k < triangles.size(); ++k) {
    if (k + triangles_ahead < triangles.size())
      __builtin_prefetch(&table_.triangles_[triangles[k + triangles_ahead]]);
    if (k + corners_ahead < triangles.size()) {
      for (const Index v : table_.triangles_[triangles[k + corners_ahead]])
        __builtin_prefetch(&table_.vertices_[v]);
    }
    const Index i = point_of_circle_[pairs_.circle[k]];
    const Vec3& point = point_[i];
    cut_point_[cuts_.size()] = i, cut_triangle_[cuts_.size()] = triangles[k];
    cuts_.put(point, point.x() * point.x() + point.y() * point.y(), table_.corner_refs(triangles[k]));
    if (cuts_.full()) take_verdicts();
  }
  take_verdicts();
}

void RingTable::Chunk::take_verdicts() {
  cuts_.decide();
  work_.cut += cuts_.size();
  // At most two of each.
  crossing_.resize(crossings_ + 2 * cuts_.size());
  for (std::size_t k = 0; k < cuts_.size(); ++k) {
    const Index i = cut_point_[k], triangle = cut_triangle_[k];
    const CutVerdict verdict = cuts_.verdict(k);
    if (verdict == CutVerdict::undecided) {
      decide_exactly(i, triangle);
    } else {
      crossing_[crossings_] = {cuts_.angle(k), static_cast<Passage>(verdict), triangle};
      crossings_ += verdict != CutVerdict::none;
    }
    end_[i] = crossings_;
  }
  cuts_.clear();
}

void RingTable::Chunk::decide_exactly(std::size_t i, Index triangle) {
  const Vec3& p = point_[i];
  const TriangleRef corners = table_.corner_refs(triangle);
  if (p.x() != 0 || p.y() != 0) {
    exact_.clear();
    add_crossings(table_.circle_of(p), corners, triangle, exact_, work_);
    for (const CircleCrossing& crossing : exact_) crossing_[crossings_++] = crossing;
  }
  const auto& [a, b, c] = corners;
  if (holding_[i] == no_index && orientation(*a, *b, *c, p) == Sign::zero &&
      contains_coplanar(table_.corners(triangle), p))
    holding_[i] = triangle;
}

std::span<const CircleCrossing> RingTable::Chunk::crossings_of(std::size_t i) noexcept {
  const std::size_t begin = i == 0 ? 0 : end_[i - 1];
  const std::span<CircleCrossing> crossings(crossing_.data() + begin, end_[i] - begin);
  sort_few(crossings);
  assert(std::accumulate(crossings.begin(), crossings.end(), 0,
                         [](int sum, const auto& c) { return sum + static_cast<int>(c.passage); }) == 0);
  return crossings;
}

RingTable::Chunk::Survey RingTable::Chunk::survey(std::size_t i) {
  const Vec3& p = point_[i];
  // No surface has that radius and height: the ring about the axis reaches out of everything.
  if (cell_[i] == no_index) return {p, PointState::outside, 0, no_index, {}};
  const auto crossings = crossings_of(i);
  const bool on_surface = holding_[i] != no_index;
  const int winding = table_.winding_ahead_of(table_.circle_of(p), cell_[i], on_surface, crossings, work_);
  const PointState state = on_surface    ? PointState::on_surface
                           : winding > 0 ? PointState::inside
                                         : PointState::outside;
  return {p, state, winding, holding_[i], crossings};
}

namespace {

void set_hit(TangentialHits& out, std::size_t i, PointState state, int winding, const AngularGap& gap,
             double radius) noexcept {
  out.state[i] = state, out.winding[i] = winding;
  out.angular_gap[i] = gap.angle;
  // On the axis the gap is infinite, its length too.
  out.arc_gap[i] = std::isinf(gap.angle) ? gap.angle : gap.angle * radius;
  out.triangle[i] = gap.triangle, out.turn[i] = gap.turn;
}

}  // namespace

void RingTable::answer_alternating(Chunk& chunk, std::size_t at, TangentialHits& out, std::size_t i) const {
  const auto survey = chunk.survey(at);
  const bool on_surface = survey.state == PointState::on_surface;
  const AngularGap gap = on_surface ? AngularGap{0, survey.triangle, Turn::none}
                                    : gap_at_point(survey.winding, survey.crossings);
  set_hit(out, i, survey.state, survey.winding, gap, axis_radius(survey.point.x(), survey.point.y()));
}

void RingTable::answer_nearest_arc(Chunk& chunk, std::size_t at, TangentialHits& out, std::size_t i) const {
  const auto crossings = chunk.crossings_of(at);
  const Vec3& point = chunk.point(at);
  if (crossings.empty()) {
    set_hit(out, i, PointState::outside, 0, {}, 0);
    return;
  }
  const auto nearest = std::min_element(crossings.begin(), crossings.end(), [](const auto& a, const auto& b) {
    return std::abs(a.angle) < std::abs(b.angle);
  });
  const auto [a, b, c] = corners(nearest->triangle);
  const Sign side = orientation(a, b, c, point);
  const PointState state = side == Sign::negative ? PointState::inside
                           : side == Sign::zero   ? PointState::on_surface
                                                  : PointState::outside;
  const Turn turn = side == Sign::zero ? Turn::none : nearest->angle > 0 ? Turn::positive : Turn::negative;
  set_hit(out, i, state, side == Sign::negative ? 1 : 0,
          {static_cast<int>(side) * std::abs(nearest->angle), nearest->triangle, turn},
          axis_radius(point.x(), point.y()));
}

void RingTable::query(PointsView points, TangentialHits& out, TangentialRule rule) const {
  out.resize(points.size());
  out.work = {};
  std::mutex adding;
  parallel_chunks(points.size(), points_per_chunk, [&](std::size_t first, std::size_t last) {
    Chunk chunk(*this);
    for (std::size_t begin = first; begin < last; begin += points_per_chunk) {
      const std::size_t end = std::min(last, begin + points_per_chunk);
      chunk.cross(points.subspan(begin, end - begin));
      for (std::size_t i = begin; i < end; ++i) {
        if (rule == TangentialRule::alternating) {
          answer_alternating(chunk, i - begin, out, i);
        } else {
          answer_nearest_arc(chunk, i - begin, out, i);
        }
      }
    }
    const std::scoped_lock lock(adding);
    out.work += chunk.work();
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
    Chunk chunk(*this);
    for (std::size_t c = first; c < last; ++c) {
      const std::size_t begin = c * points_per_chunk, end = std::min(points.size(), begin + points_per_chunk);
      chunk.cross(points.subspan(begin, end - begin));
      for (std::size_t i = begin; i < end; ++i) {
        const auto survey = chunk.survey(i - begin);
        append_arcs(survey.winding, survey.crossings, arcs[c]);
        offset[i + 1] = arcs[c].size();
      }
    }
  });
  std::vector<OccupiedArc> all;
  for (std::size_t c = 0; c < chunks; ++c) {
    const std::size_t end = std::min(points.size(), (c + 1) * points_per_chunk);
    for (std::size_t i = c * points_per_chunk; i < end; ++i) offset[i + 1] += all.size();
    all.insert(all.end(), arcs[c].begin(), arcs[c].end());
  }
  return {std::move(offset), std::move(all)};
}

}  // namespace condyle
