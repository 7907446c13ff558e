#include "tangential/exact/occupied_arcs.hpp"

#include <algorithm>
#include <cassert>
#include <limits>
#include <utility>

#include "core/wrapped_angle.hpp"

namespace condyle::tangential {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

constexpr OccupiedArc whole_circle{Angle(), Angle::radians(two_pi), no_index, no_index};

/// Start of an arc: less than a turn ahead, also for a crossing that is behind the point by less than rounding
/// resolves.
double begin_of(const CircleCrossing& enters) noexcept {
  constexpr double last = two_pi - 0x1p-50;  // the double before it
  return std::min(enters.ahead(), last);
}

/// An arc that rounding leaves no length is none.
bool is_empty(const OccupiedArc& arc) noexcept {
  return !(arc.begin < arc.end);
}

/// visit(crossing, now_inside) wherever the circle comes into the solid or out of it, in order. Crossings at
/// one angle act together: bodies that touch there are one, a sheet of no thickness is none.
template <class Visit>
void for_each_change(int winding, std::span<const CircleCrossing> crossings, const Visit& visit) {
  for (std::size_t first = 0; first < crossings.size();) {
    const bool was_inside = winding > 0;
    std::size_t end = first;
    for (; end < crossings.size() && crossings[end].angle == crossings[first].angle; ++end) {
      winding += static_cast<int>(crossings[end].passage);
    }
    const bool now_inside = winding > 0;
    if (now_inside != was_inside) {
      const Passage passage = now_inside ? Passage::enters : Passage::leaves;
      while (crossings[first].passage != passage) ++first;
      visit(crossings[first], now_inside);
    }
    first = end;
  }
}

/// Whether entries and exits alternate, each at an angle of its own, between winding numbers 0 and 1: nearly
/// always.
bool alternate(int winding, std::span<const CircleCrossing> crossings) noexcept {
  bool so = (winding == 0) | (winding == 1);
  int passage = winding == 0 ? 1 : -1;
  for (std::size_t i = 0; i < crossings.size(); ++i, passage = -passage) {
    so &= static_cast<int>(crossings[i].passage) == passage;
    so &= i == 0 || crossings[i].angle != crossings[i - 1].angle;
  }
  return so;
}

}  // namespace

void append_arcs(int winding, std::span<const CircleCrossing> crossings, std::vector<OccupiedArc>& arcs) {
  if (crossings.empty()) {
    if (winding > 0) arcs.push_back(whole_circle);
    return;
  }
  if (alternate(winding, crossings)) {
    std::size_t i = static_cast<std::size_t>(winding);
    for (; i + 1 < crossings.size(); i += 2) {
      const CircleCrossing &enters = crossings[i], &leaves = crossings[i + 1];
      const OccupiedArc arc{Angle::radians(begin_of(enters)), Angle::radians(leaves.ahead()), enters.triangle,
                            leaves.triangle};
      if (!is_empty(arc)) arcs.push_back(arc);
    }
    if (i < crossings.size())
      arcs.push_back({Angle::radians(begin_of(crossings[i])), Angle::radians(crossings[0].ahead() + two_pi),
                      crossings[i].triangle, crossings[0].triangle});
    return;
  }
  const std::size_t first = arcs.size();
  // Inside from the start: what ends first is the end of the last arc, one turn on.
  const CircleCrossing* end_of_last = nullptr;
  for_each_change(winding, crossings, [&](const CircleCrossing& crossing, bool now_inside) {
    if (now_inside) {
      arcs.push_back({Angle::radians(begin_of(crossing)), Angle(), crossing.triangle, no_index});
    } else if (arcs.size() == first) {
      end_of_last = &crossing;
    } else {
      arcs.back().end = Angle::radians(crossing.ahead()), arcs.back().leaves = crossing.triangle;
      if (is_empty(arcs.back())) arcs.pop_back();
    }
  });
  if (end_of_last) {
    arcs.back().end = Angle::radians(end_of_last->ahead() + two_pi);
    arcs.back().leaves = end_of_last->triangle;
  } else if (winding > 0) {
    arcs.push_back(whole_circle);
  }
}

AngularGap gap_at_point(int winding, std::span<const CircleCrossing> crossings) noexcept {
  const bool inside = winding > 0;
  // Ends of the solid, ahead and behind.
  const CircleCrossing *next = nullptr, *previous = nullptr;
  for_each_change(winding, crossings, [&](const CircleCrossing& crossing, bool) {
    if (!next) next = &crossing;
    previous = &crossing;
  });
  if (!next) return {Angle::radians(inside ? -infinity : infinity), no_index, RotationSense::none};
  const bool go_ahead = next->ahead() <= previous->behind();
  const double angle = go_ahead ? next->ahead() : previous->behind();
  return {Angle::radians(inside ? -angle : angle), (go_ahead ? next : previous)->triangle,
          go_ahead ? RotationSense::positive : RotationSense::negative};
}

OccupiedArcs::OccupiedArcs(std::vector<std::size_t> offset, std::vector<OccupiedArc> arcs)
    : offset_(std::move(offset)), arc_(std::move(arcs)) {
  assert(!offset_.empty() && offset_.back() == arc_.size());
}

bool OccupiedArcs::inside_at(std::size_t point, Angle phi) const noexcept {
  return gap_at(point, phi).angle < Angle();
}

AngularGap OccupiedArcs::gap_at(std::size_t point, Angle phi) const noexcept {
  const auto arcs = of(point);
  if (arcs.empty()) return {};
  if (arcs.front().enters == no_index)
    return {-Angle::radians(std::numeric_limits<double>::infinity()), no_index, RotationSense::none};
  const Angle angle = Angle::radians(core::wrapped(phi.radians())), turn = Angle::radians(two_pi);
  // The last arc that begins at the angle or before it; from the turn before if there is none.
  const auto after = std::upper_bound(arcs.begin(), arcs.end(), angle,
                                      [](Angle value, const OccupiedArc& arc) { return value < arc.begin; });
  const bool wraps = after == arcs.begin();
  const OccupiedArc& last = wraps ? arcs.back() : *(after - 1);
  const Angle since_begin = angle - last.begin + (wraps ? turn : Angle());
  const Angle to_end = last.end - angle - (wraps ? turn : Angle());
  if (to_end > Angle()) {
    if (to_end <= since_begin) return {-to_end, last.leaves, RotationSense::positive};
    // At the very first angle of an arc the gap is zero, and the point inside: never quite 0.
    const Angle least = Angle::radians(std::numeric_limits<double>::min());
    return {-std::max(since_begin, least), last.enters, RotationSense::negative};
  }
  const bool beyond_all = after == arcs.end();
  const OccupiedArc& next = beyond_all ? arcs.front() : *after;
  const Angle to_begin = next.begin - angle + (beyond_all ? turn : Angle());
  if (to_begin <= -to_end) return {to_begin, next.enters, RotationSense::positive};
  return {-to_end, last.leaves, RotationSense::negative};
}

}  // namespace condyle::tangential
