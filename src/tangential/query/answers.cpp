#include "tangential/query/answers.hpp"

#include <algorithm>
#include <cmath>

#include "core/predicates.hpp"
#include "tangential/exact/occupied_arcs.hpp"

namespace condyle::tangential {
namespace {

/// One point's answer.
struct Answer {
  PointState state = PointState::outside;
  int winding = 0;
  AngularGap gap;
};

void write(const Answer& answer, double radius, std::size_t i, TangentialResults& results) noexcept {
  const double angle = answer.gap.angle.radians();
  results.state[i] = answer.state, results.winding[i] = answer.winding;
  results.angular_gap[i] = answer.gap.angle;
  // On the axis the gap is infinite, its length too.
  results.arc_gap_mm[i] = std::isinf(angle) ? angle : angle * radius;
  results.triangle[i] = answer.gap.triangle, results.rotation_sense[i] = answer.gap.rotation_sense;
}

Answer by_alternating(CircleBatch& batch, std::size_t circle) {
  const auto [state, winding, triangle, crossings] = batch.classify(circle);
  const bool on_surface = state == PointState::on_surface;
  return {state, winding,
          on_surface ? AngularGap{Angle(), triangle, RotationSense::none} : gap_at_point(winding, crossings)};
}

Answer by_nearest_arc(CircleBatch& batch, const Rings& rings, std::size_t circle) {
  const auto crossings = batch.crossings_of(circle);
  if (crossings.empty()) return {};
  const auto nearest = std::min_element(crossings.begin(), crossings.end(), [](const auto& a, const auto& b) {
    return std::abs(a.angle) < std::abs(b.angle);
  });
  const auto [a, b, c] = rings.corners(nearest->triangle);
  const core::Sign side = core::orientation(a, b, c, batch.circles().point[circle].at());
  const PointState state = side == core::Sign::negative ? PointState::inside
                           : side == core::Sign::zero   ? PointState::on_surface
                                                        : PointState::outside;
  const RotationSense sense = side == core::Sign::zero ? RotationSense::none
                              : nearest->angle > 0     ? RotationSense::positive
                                                       : RotationSense::negative;
  const Angle gap = Angle::radians(static_cast<int>(side) * std::abs(nearest->angle));
  return {state, side == core::Sign::negative ? 1 : 0, {gap, nearest->triangle, sense}};
}

}  // namespace

void write_results(CircleBatch& batch, const Rings& rings, std::size_t begin, std::size_t end,
                   TangentialRule rule, TangentialResults& results) {
  std::size_t i = begin;
  const auto outside_until = [&](std::size_t last) {
    for (; i < last; ++i) write({}, 0, i, results);
  };
  const LocatedCircles& circles = batch.circles();
  for (std::size_t circle = 0; circle < circles.size(); ++circle) {
    outside_until(begin + circles.number[circle]);
    const Answer answer = rule == TangentialRule::alternating ? by_alternating(batch, circle)
                                                              : by_nearest_arc(batch, rings, circle);
    write(answer, std::sqrt(circles.point[circle].squared_radius), i++, results);
  }
  outside_until(end);
}

void append_arcs(CircleBatch& batch, std::size_t* counts, std::vector<OccupiedArc>& arcs) {
  arcs.reserve(arcs.size() + batch.most_arcs());
  for (std::size_t circle = 0; circle < batch.circles().size(); ++circle) {
    const std::size_t before = arcs.size();
    const auto classified = batch.classify(circle);
    append_arcs(classified.winding, classified.crossings, arcs);
    counts[batch.circles().number[circle]] = arcs.size() - before;
  }
}

}  // namespace condyle::tangential
