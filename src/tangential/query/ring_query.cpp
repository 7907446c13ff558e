#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <mutex>
#include <numeric>

#include "core/parallel.hpp"
#include "tangential/query/circle_cuts.hpp"
#include "tangential/ring_table.hpp"

namespace condyle {
namespace {

/// Points taken together: enough that starting with the next ones costs next to nothing, few enough that all
/// about them stays in the processor's nearer caches.
constexpr std::size_t points_per_chunk = 1024;

/// Least radius, in units of the table's scale, at which crossings err by less than half the clearance of
/// free directions: sqrt(2 * 17u / 2^-20) < 2^-13 (see add_crossings). Circles in the table's grid have a
/// scale of at most sqrt(2) times the table's.
constexpr double least_anchored_radius = 1.5 * 0x1p-20;

/// As atan2(y, x), off by at most 1.1e-5 (Abramowitz and Stegun 1964, 4.4.49): far less than the other half
/// of the clearance, and many times faster. Not for the point on the axis.
double rough_angle(double x, double y) noexcept {
  const double a = std::abs(x), b = std::abs(y), q = std::min(a, b) / std::max(a, b), s = q * q;
  double angle = q * (0.9998660 + s * (-0.3302995 + s * (0.1801410 + s * (-0.0851330 + s * 0.0208351))));
  angle = b > a ? two_pi / 4 - angle : angle;
  angle = x < 0 ? two_pi / 2 - angle : angle;
  return y < 0 ? -angle : angle;
}

/// Just ahead of the point, by the winding number in a direction and the crossings between there and the
/// point.
int winding_from(int direction, int winding, const tangential::TurningPoint& point,
                 std::span<const tangential::CircleCrossing> crossings) noexcept {
  if (crossings.empty()) return winding;
  const double turn =
      tangential::FreeDirections::angle_of(direction).radians() - rough_angle(point.x, point.y);
  const double way = turn < 0 ? turn + two_pi : turn > two_pi ? turn - two_pi : turn;
  for (const tangential::CircleCrossing& crossing : crossings)
    winding -= crossing.ahead() < way ? static_cast<int>(crossing.passage) : 0;
  return winding;
}

/// Few, nearly always: two to six.
void sort_few(std::span<tangential::CircleCrossing> crossings) {
  constexpr std::size_t few = 24;
  if (crossings.size() > few) {
    std::sort(crossings.begin(), crossings.end());
    return;
  }
  for (std::size_t i = 1; i < crossings.size(); ++i) {
    const tangential::CircleCrossing moved = crossings[i];
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
  explicit Chunk(const RingTable& table) : table_(table) {}

  /// Finds all crossings of the circles of these points.
  void cross(PointsView points);

  /// The circles within the table's grid. Points without one are outside, and no turn changes that.
  const tangential::PlacedCircles& circles() const noexcept { return circles_; }

  /// What is known of one circle's point.
  struct Survey {
    PointState state;
    int winding;     ///< Just ahead of the point.
    Index triangle;  ///< One that holds the point.
    std::span<const tangential::CircleCrossing> crossings;
  };
  Survey survey(std::size_t circle);
  /// Circles that may have arcs, ascending: all but those that cross no surface and are known to be outside,
  /// which are most. Told without a branch, for nobody could foretell which they are.
  std::span<const Index> circles_to_survey();
  /// Of one circle, in order.
  std::span<const tangential::CircleCrossing> crossings_of(std::size_t circle);

  /// At least as many as the circles have arcs: one for two crossings, or a whole turn.
  std::size_t most_arcs() const noexcept { return crossings_ / 2 + circles_.size(); }

  const tangential::TangentialWork& work() const noexcept { return work_; }

 private:
  void cut();
  void take_verdicts();
  void decide_exactly(std::size_t circle, Index triangle);
  int winding_ahead_of(std::size_t circle, bool on_surface,
                       std::span<const tangential::CircleCrossing> crossings);
  std::size_t begin_of(std::size_t circle) const noexcept { return circle == 0 ? 0 : end_[circle - 1]; }
  /// Whether the free direction of its cell tells the winding number of a point that is not on the surface.
  bool is_anchored(std::size_t circle, tangential::FreeDirections::Anchor anchor) const noexcept {
    const double least_radius = least_anchored_radius * table_.scale_;
    const bool is_far = circles_.point[circle].squared_radius >= least_radius * least_radius;
    return (anchor.direction != tangential::FreeDirections::none) & is_far;
  }

  const RingTable& table_;
  tangential::PlacedCircles circles_;
  tangential::CirclePairs pairs_;
  tangential::CircleCuts cuts_;
  /// Crossings of circle i are [end_[i - 1], end_[i]).
  core::UninitialisedVector<tangential::CircleCrossing> crossing_;
  std::size_t crossings_ = 0;
  std::array<std::size_t, points_per_chunk> end_;
  std::array<Index, points_per_chunk> holding_;  ///< The first triangle that holds the point.
  std::array<Index, points_per_chunk> to_survey_;
  std::vector<tangential::CircleCrossing> exact_;
  tangential::TangentialWork work_;
};

void RingTable::Chunk::cross(PointsView points) {
  tangential::place_circles(table_.frame_, table_.grid(), points, circles_);
  const tangential::RingLists& lists = table_.lists_;
  for (const tangential::CirclePlace& place : circles_.place)
    lists.fetch_offset(place.cell), table_.free_.fetch(place.cell);
  for (const tangential::CirclePlace& place : circles_.place) {
    lists.fetch_list(place.cell);
    work_.candidates += lists.of(place.cell).size();
  }
  crossings_ = 0;
  for (std::size_t i = 0; i < circles_.size(); ++i) end_[i] = 0, holding_[i] = no_index;
  for (std::size_t done = 0; done < circles_.size();) {
    done = lists.find(circles_.place, done, pairs_);
    cut();
  }
  for (std::size_t i = 0, end = 0; i < circles_.size(); ++i) end_[i] = end = std::max(end, end_[i]);
  work_.points += points.size(), work_.crossings += crossings_;
}

void RingTable::Chunk::cut() {
  const tangential::CutSource source{table_.vertices_.data(), table_.triangles_.data(), table_.scale_};
  for (std::size_t first = 0; first < pairs_.triangle.size(); first += tangential::CircleCuts::most) {
    tangential::cut_circles(source, circles_.point, pairs_.circle, pairs_.triangle, first, cuts_);
    take_verdicts();
  }
  work_.tried += pairs_.triangle.size();
}

void RingTable::Chunk::take_verdicts() {
  // At most two of each.
  crossing_.resize(crossings_ + 2 * cuts_.count);
  for (std::size_t k = 0; k < cuts_.count; ++k) {
    const Index circle = pairs_.circle[cuts_.pair[k]], triangle = pairs_.triangle[cuts_.pair[k]];
    const auto verdict = static_cast<tangential::CutVerdict>(static_cast<signed char>(cuts_.verdict[k]));
    if (verdict == tangential::CutVerdict::undecided) {
      decide_exactly(circle, triangle);
    } else {
      crossing_[crossings_++] = {cuts_.angle[k], static_cast<tangential::Passage>(verdict), triangle};
    }
    end_[circle] = crossings_;
  }
}

void RingTable::Chunk::decide_exactly(std::size_t circle, Index triangle) {
  const Vec3 p = circles_.point[circle].at();
  const tangential::TriangleRef corners = table_.corner_refs(triangle);
  if (p.x() != 0 || p.y() != 0) {
    exact_.clear();
    tangential::add_crossings(table_.circle_of(p), corners, triangle, exact_, work_);
    for (const tangential::CircleCrossing& crossing : exact_) crossing_[crossings_++] = crossing;
  }
  const auto& [a, b, c] = corners;
  if (core::orientation(*a, *b, *c, p) == core::Sign::zero &&
      mesh::contains_coplanar(table_.corners(triangle), p))
    holding_[circle] = std::min(holding_[circle], triangle);
}

std::span<const tangential::CircleCrossing> RingTable::Chunk::crossings_of(std::size_t circle) {
  const std::size_t begin = begin_of(circle);
  const std::span<tangential::CircleCrossing> crossings(crossing_.data() + begin, end_[circle] - begin);
  sort_few(crossings);
  assert(std::accumulate(crossings.begin(), crossings.end(), 0,
                         [](int sum, const auto& c) { return sum + static_cast<int>(c.passage); }) == 0);
  return crossings;
}

std::span<const Index> RingTable::Chunk::circles_to_survey() {
  std::size_t count = 0;
  for (std::size_t i = 0; i < circles_.size(); ++i) {
    const tangential::FreeDirections::Anchor anchor = table_.free_.of(circles_.place[i].cell);
    const bool is_outside = is_anchored(i, anchor) & (anchor.winding <= 0);
    const std::size_t begin = begin_of(i), end = end_[i];
    const Index holding = holding_[i];
    const bool is_met = (end != begin) | (holding != no_index);
    to_survey_[count] = static_cast<Index>(i);
    count += is_met | !is_outside;
  }
  return std::span(to_survey_).first(count);
}

RingTable::Chunk::Survey RingTable::Chunk::survey(std::size_t circle) {
  const auto crossings = crossings_of(circle);
  const bool on_surface = holding_[circle] != no_index;
  const int winding = winding_ahead_of(circle, on_surface, crossings);
  const PointState state = on_surface    ? PointState::on_surface
                           : winding > 0 ? PointState::inside
                                         : PointState::outside;
  return {state, winding, holding_[circle], crossings};
}

/// From the free direction of the cell; where there is no such direction, and for points on the surface, by a
/// ray.
int RingTable::Chunk::winding_ahead_of(std::size_t circle, bool on_surface,
                                       std::span<const tangential::CircleCrossing> crossings) {
  const tangential::TurningPoint& point = circles_.point[circle];
  const tangential::FreeDirections::Anchor anchor = table_.free_.of(circles_.place[circle].cell);
  if (!on_surface && is_anchored(circle, anchor))
    return winding_from(anchor.direction, anchor.winding, point, crossings);
  if (point.x == 0 && point.y == 0) return on_surface ? 0 : table_.winding_on_axis(point.at());
  return table_.winding_outwards(table_.circle_of(point.at()), circles_.place[circle], work_);
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

void RingTable::answer_alternating(Chunk& chunk, std::size_t circle, TangentialHits& out,
                                   std::size_t i) const {
  const auto survey = chunk.survey(circle);
  const bool on_surface = survey.state == PointState::on_surface;
  const AngularGap gap = on_surface ? AngularGap{0, survey.triangle, Turn::none}
                                    : gap_at_point(survey.winding, survey.crossings);
  set_hit(out, i, survey.state, survey.winding, gap, std::sqrt(chunk.circles().point[circle].squared_radius));
}

void RingTable::answer_nearest_arc(Chunk& chunk, std::size_t circle, TangentialHits& out,
                                   std::size_t i) const {
  const auto crossings = chunk.crossings_of(circle);
  if (crossings.empty()) {
    set_hit(out, i, PointState::outside, 0, {}, 0);
    return;
  }
  const tangential::TurningPoint& point = chunk.circles().point[circle];
  const auto nearest = std::min_element(crossings.begin(), crossings.end(), [](const auto& a, const auto& b) {
    return std::abs(a.angle) < std::abs(b.angle);
  });
  const auto [a, b, c] = corners(nearest->triangle);
  const core::Sign side = core::orientation(a, b, c, point.at());
  const PointState state = side == core::Sign::negative ? PointState::inside
                           : side == core::Sign::zero   ? PointState::on_surface
                                                        : PointState::outside;
  const Turn turn = side == core::Sign::zero ? Turn::none
                    : nearest->angle > 0     ? Turn::positive
                                             : Turn::negative;
  set_hit(out, i, state, side == core::Sign::negative ? 1 : 0,
          {static_cast<int>(side) * std::abs(nearest->angle), nearest->triangle, turn},
          std::sqrt(point.squared_radius));
}

void RingTable::answer(Chunk& chunk, std::size_t begin, std::size_t end, TangentialRule rule,
                       TangentialHits& out) const {
  std::size_t i = begin;
  const auto nothing_until = [&](std::size_t last) {
    for (; i < last; ++i) set_hit(out, i, PointState::outside, 0, {}, 0);
  };
  for (std::size_t circle = 0; circle < chunk.circles().size(); ++circle) {
    nothing_until(begin + chunk.circles().number[circle]);
    if (rule == TangentialRule::alternating) {
      answer_alternating(chunk, circle, out, i++);
    } else {
      answer_nearest_arc(chunk, circle, out, i++);
    }
  }
  nothing_until(end);
}

void RingTable::query(PointsView points, TangentialHits& out, TangentialRule rule) const {
  out.resize(points.size());
  out.work = {};
  std::mutex adding;
  core::parallel_chunks(points.size(), points_per_chunk, [&](std::size_t first, std::size_t last) {
    Chunk chunk(*this);
    for (std::size_t begin = first; begin < last; begin += points_per_chunk) {
      const std::size_t end = std::min(last, begin + points_per_chunk);
      chunk.cross(points.subspan(begin, end - begin));
      answer(chunk, begin, end, rule, out);
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
  // For now the number of arcs of each point, one to the right.
  std::vector<std::size_t> offset(points.size() + 1, 0);
  std::size_t* const count = offset.data() + 1;
  core::parallel_chunks(chunks, 1, [&](std::size_t first, std::size_t last) {
    Chunk chunk(*this);
    for (std::size_t c = first; c < last; ++c) {
      const std::size_t begin = c * points_per_chunk, end = std::min(points.size(), begin + points_per_chunk);
      chunk.cross(points.subspan(begin, end - begin));
      arcs[c].reserve(chunk.most_arcs());
      for (const Index circle : chunk.circles_to_survey()) {
        const std::size_t before = arcs[c].size();
        const auto survey = chunk.survey(circle);
        append_arcs(survey.winding, survey.crossings, arcs[c]);
        count[begin + chunk.circles().number[circle]] = arcs[c].size() - before;
      }
    }
  });
  std::vector<OccupiedArc> all;
  all.reserve(std::accumulate(arcs.begin(), arcs.end(), std::size_t{0},
                              [](std::size_t sum, const auto& some) { return sum + some.size(); }));
  for (const auto& some : arcs) all.insert(all.end(), some.begin(), some.end());
  std::partial_sum(offset.begin(), offset.end(), offset.begin());
  return {std::move(offset), std::move(all)};
}

}  // namespace condyle
