#include "tangential/exact/occupied_arcs.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace condyle {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// phi in [0, 2 pi).
double within_one_turn(Angle phi) noexcept {
  const double rest = std::fmod(phi.radians(), two_pi);
  const double turned = rest < 0 ? rest + two_pi : rest;
  return turned < two_pi ? turned : 0;
}

/// visit(crossing, now_inside) wherever the circle comes into the solid or out of it, in order. Crossings at
/// one angle act together: bodies that touch there are one, a sheet of no thickness is none.
template <class Visit>
void for_each_change(int winding, std::span<const tangential::CircleCrossing> crossings, const Visit& visit) {
  for (std::size_t first = 0; first < crossings.size();) {
    const bool was_inside = winding > 0;
    std::size_t end = first;
    for (; end < crossings.size() && crossings[end].angle == crossings[first].angle; ++end) {
      winding += static_cast<int>(crossings[end].passage);
    }
    const bool now_inside = winding > 0;
    if (now_inside != was_inside) {
      const tangential::Passage passage =
          now_inside ? tangential::Passage::enters : tangential::Passage::leaves;
      while (crossings[first].passage != passage) ++first;
      visit(crossings[first], now_inside);
    }
    first = end;
  }
}

/// Whether entries and exits take turns, each at an angle of its own, between places outside and places that
/// are once inside: nearly always.
bool take_turns(int winding, std::span<const tangential::CircleCrossing> crossings) noexcept {
  bool so = (winding == 0) | (winding == 1);
  int passage = winding == 0 ? 1 : -1;
  for (std::size_t i = 0; i < crossings.size(); ++i, passage = -passage) {
    so &= static_cast<int>(crossings[i].passage) == passage;
    so &= i == 0 || crossings[i].angle != crossings[i - 1].angle;
  }
  return so;
}

}  // namespace

void append_arcs(int winding, std::span<const tangential::CircleCrossing> crossings,
                 std::vector<OccupiedArc>& arcs) {
  if (crossings.empty()) {
    if (winding > 0) arcs.push_back({0, two_pi, no_index, no_index});
    return;
  }
  if (take_turns(winding, crossings)) {
    std::size_t i = static_cast<std::size_t>(winding);
    for (; i + 1 < crossings.size(); i += 2) {
      const tangential::CircleCrossing &enters = crossings[i], &leaves = crossings[i + 1];
      arcs.push_back({enters.ahead(), leaves.ahead(), enters.triangle, leaves.triangle});
    }
    if (i < crossings.size())
      arcs.push_back({crossings[i].ahead(), crossings[0].ahead() + two_pi, crossings[i].triangle,
                      crossings[0].triangle});
    return;
  }
  const std::size_t first = arcs.size();
  // Inside from the start: what ends first is the end of the last arc, one turn on.
  const tangential::CircleCrossing* end_of_last = nullptr;
  for_each_change(winding, crossings, [&](const tangential::CircleCrossing& crossing, bool now_inside) {
    if (now_inside) {
      arcs.push_back({crossing.ahead(), 0, crossing.triangle, no_index});
    } else if (arcs.size() == first) {
      end_of_last = &crossing;
    } else {
      arcs.back().end = crossing.ahead(), arcs.back().leaves = crossing.triangle;
    }
  });
  if (end_of_last) {
    arcs.back().end = end_of_last->ahead() + two_pi, arcs.back().leaves = end_of_last->triangle;
  } else if (winding > 0) {
    arcs.push_back({0, two_pi, no_index, no_index});
  }
}

AngularGap gap_at_point(int winding, std::span<const tangential::CircleCrossing> crossings) noexcept {
  const bool inside = winding > 0;
  const tangential::CircleCrossing *next = nullptr,
                                   *previous = nullptr;  // ends of the solid, ahead and behind
  for_each_change(winding, crossings, [&](const tangential::CircleCrossing& crossing, bool) {
    if (!next) next = &crossing;
    previous = &crossing;
  });
  if (!next) return {inside ? -infinity : infinity, no_index, Turn::none};
  const bool go_ahead = next->ahead() <= previous->behind();
  const double way = go_ahead ? next->ahead() : previous->behind();
  return {inside ? -way : way, (go_ahead ? next : previous)->triangle,
          go_ahead ? Turn::positive : Turn::negative};
}

OccupiedArcs::OccupiedArcs(std::vector<std::size_t> offset, std::vector<OccupiedArc> arcs)
    : offset_(std::move(offset)), arc_(std::move(arcs)) {
  assert(!offset_.empty() && offset_.back() == arc_.size());
}

bool OccupiedArcs::inside_at(std::size_t point, Angle phi) const noexcept {
  return gap_at(point, phi).angle < 0;
}

AngularGap OccupiedArcs::gap_at(std::size_t point, Angle phi) const noexcept {
  const auto arcs = of(point);
  if (arcs.empty()) return {};
  if (arcs.front().enters == no_index) return {-infinity, no_index, Turn::none};
  const double angle = within_one_turn(phi);
  // The last arc that begins at the angle or before it; from the turn before where none does.
  const auto after = std::upper_bound(arcs.begin(), arcs.end(), angle,
                                      [](double value, const OccupiedArc& arc) { return value < arc.begin; });
  const bool wraps = after == arcs.begin();
  const OccupiedArc& last = wraps ? arcs.back() : *(after - 1);
  const double since_begin = angle - last.begin + (wraps ? two_pi : 0);
  const double to_end = last.end - angle - (wraps ? two_pi : 0);
  if (to_end > 0) {
    if (to_end <= since_begin) return {-to_end, last.leaves, Turn::positive};
    // On the very first angle of an arc the way out is zero, and the point inside: never quite 0.
    return {-std::max(since_begin, std::numeric_limits<double>::min()), last.enters, Turn::negative};
  }
  const bool beyond_all = after == arcs.end();
  const OccupiedArc& next = beyond_all ? arcs.front() : *after;
  const double to_begin = next.begin - angle + (beyond_all ? two_pi : 0);
  if (to_begin <= -to_end) return {to_begin, next.enters, Turn::positive};
  return {-to_end, last.leaves, Turn::negative};
}

}  // namespace condyle
