#include "tangential/query/circle_batch.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

#include "core/predicates.hpp"
#include "core/wrapped_angle.hpp"
#include "mesh/triangle_intersection.hpp"
#include "tangential/query/winding.hpp"

namespace condyle::tangential {
namespace {

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
int winding_from(FreeDirections::Anchor anchor, const CirclePoint& point,
                 std::span<const CircleCrossing> crossings) noexcept {
  int winding = anchor.winding;
  if (crossings.empty()) return winding;
  const double between = FreeDirections::angle_of(anchor.direction).radians() - rough_angle(point.x, point.y);
  const double ahead = core::wrapped(between);
  for (const CircleCrossing& crossing : crossings)
    winding -= crossing.ahead() < ahead ? static_cast<int>(crossing.passage) : 0;
  return winding;
}

/// Few, nearly always: two to six.
void sort_few(std::span<CircleCrossing> crossings) {
  constexpr std::size_t few = 24;
  if (crossings.size() > few) {
    std::sort(crossings.begin(), crossings.end());
    return;
  }
  for (std::size_t i = 1; i < crossings.size(); ++i) {
    const CircleCrossing moved = crossings[i];
    std::size_t at = i;
    for (; at > 0 && moved < crossings[at - 1]; --at) crossings[at] = crossings[at - 1];
    crossings[at] = moved;
  }
}

}  // namespace

void CircleBatch::find_crossings(PointsView points) {
  assert(points.size() <= most);
  locate_circles(rings_.frame, rings_.grid(), points, circles_);
  prefetch_lists();
  crossing_count_ = 0;
  for (std::size_t i = 0; i < circles_.size(); ++i) end_[i] = 0, holding_[i] = no_index;
  for (std::size_t done = 0; done < circles_.size();) {
    done = gather_candidates(rings_.lists, circles_.cell, done, pairs_);
    evaluate_pairs();
  }
  for (std::size_t i = 0, end = 0; i < circles_.size(); ++i) end_[i] = end = std::max(end, end_[i]);
  work_.points += points.size(), work_.crossings += crossing_count_;
}

void CircleBatch::prefetch_lists() {
  const RingLists& lists = rings_.lists;
  for (const auto& [cell, bytes] : circles_.cell) {
    __builtin_prefetch(lists.offsets() + cell);
    rings_.free_directions.prefetch(cell);
  }
  for (const auto& [cell, bytes] : circles_.cell) {
    const auto list = lists.of(cell);
    __builtin_prefetch(list.data());
    work_.candidates += list.size();
  }
}

void CircleBatch::evaluate_pairs() {
  const CircleTriangles source{rings_.vertices.data(), rings_.triangles.data(), rings_.scale};
  for (std::size_t first = 0; first < pairs_.triangle.size(); first += ClassifiedPairs::most) {
    classify_crossings(source, circles_.point, pairs_.circle, pairs_.triangle, first, classified_);
    collect_crossings();
  }
  work_.evaluated += pairs_.triangle.size();
}

void CircleBatch::collect_crossings() {
  // At most two of each.
  crossing_.resize(crossing_count_ + 2 * classified_.count);
  for (std::size_t k = 0; k < classified_.count; ++k) {
    const Index circle = pairs_.circle[classified_.pair[k]], triangle = pairs_.triangle[classified_.pair[k]];
    const auto crossing_class =
        static_cast<CrossingClass>(static_cast<signed char>(classified_.crossing_class[k]));
    if (crossing_class == CrossingClass::uncertain) {
      decide_exactly(circle, triangle);
    } else {
      crossing_[crossing_count_++] = {classified_.angle[k], static_cast<Passage>(crossing_class), triangle};
    }
    end_[circle] = crossing_count_;
  }
}

void CircleBatch::decide_exactly(std::size_t circle, Index triangle) {
  const Vec3 p = circles_.point[circle].at();
  const TriangleRef corners = rings_.corner_refs(triangle);
  if (p.x() != 0 || p.y() != 0) {
    exact_.clear();
    add_crossings(circle_through(p, rings_.scale), corners, triangle, exact_, work_);
    for (const CircleCrossing& crossing : exact_) crossing_[crossing_count_++] = crossing;
  }
  const auto& [a, b, c] = corners;
  if (core::orientation(*a, *b, *c, p) == core::Sign::zero &&
      mesh::contains_coplanar(rings_.corners(triangle), p))
    holding_[circle] = std::min(holding_[circle], triangle);
}

std::span<const CircleCrossing> CircleBatch::crossings_of(std::size_t circle) {
  const std::size_t begin = begin_of(circle);
  const std::span<CircleCrossing> crossings(crossing_.data() + begin, end_[circle] - begin);
  sort_few(crossings);
  assert(std::accumulate(crossings.begin(), crossings.end(), 0,
                         [](int sum, const auto& c) { return sum + static_cast<int>(c.passage); }) == 0);
  return crossings;
}

CircleBatch::Classified CircleBatch::classify(std::size_t circle) {
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
int CircleBatch::winding_ahead_of(std::size_t circle, bool on_surface,
                                  std::span<const CircleCrossing> crossings) {
  const CirclePoint& point = circles_.point[circle];
  const CircleCell& cell = circles_.cell[circle];
  const FreeDirections::Anchor anchor = rings_.free_directions.of(cell.cell);
  const double least_radius = least_anchored_radius * rings_.scale;
  const bool is_anchored =
      anchor.direction != FreeDirections::none && point.squared_radius >= least_radius * least_radius;
  if (!on_surface && is_anchored) return winding_from(anchor, point, crossings);
  if (point.x == 0 && point.y == 0) return on_surface ? 0 : winding_on_axis(rings_, point.at());
  return winding_outwards(rings_, circle_through(point.at(), rings_.scale), cell, work_);
}

}  // namespace condyle::tangential
