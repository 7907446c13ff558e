#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "condyle/angle.hpp"
#include "core/predicates.hpp"
#include "motion/events/rotation_event.hpp"
#include "rotations/rotation_methods.hpp"

namespace bench {
namespace {

using condyle::core::Sign;
using condyle::motion::ContactEvent;
using condyle::motion::ContactEvents;
using condyle::motion::cross;
using condyle::motion::dot;

// ---- Before the motion ----

condyle::Vec3 vec3(const Point& p) {
  return {p.x, p.y, p.z};
}

/// A plane's points without one of their coordinates.
struct Flat {
  double x, y;
};
Flat flat(const Point& p, int without) {
  return without == 0 ? Flat{p.y, p.z} : without == 1 ? Flat{p.z, p.x} : Flat{p.x, p.y};
}
Sign side(const Flat& a, const Flat& b, const Flat& c) {
  return condyle::core::exact::orientation_2d(a.x, a.y, b.x, b.y, c.x, c.y);
}

/// A point that is seen on the edge's line lies between its ends.
bool is_between(const Flat& p, const Flat& a, const Flat& b) {
  return std::min(a.x, b.x) <= p.x && p.x <= std::max(a.x, b.x) && std::min(a.y, b.y) <= p.y &&
         p.y <= std::max(a.y, b.y);
}

bool segments_meet(const Flat& a, const Flat& b, const Flat& c, const Flat& d) {
  const Sign of_c = side(a, b, c), of_d = side(a, b, d), of_a = side(c, d, a), of_b = side(c, d, b);
  if (of_c * of_d == Sign::negative && of_a * of_b == Sign::negative) return true;
  return (of_c == Sign::zero && is_between(c, a, b)) || (of_d == Sign::zero && is_between(d, a, b)) ||
         (of_a == Sign::zero && is_between(a, c, d)) || (of_b == Sign::zero && is_between(b, c, d));
}

bool point_in_triangle(const Flat& p, const Flat& a, const Flat& b, const Flat& c) {
  const std::array<Sign, 3> sides = {side(a, b, p), side(b, c, p), side(c, a, p)};
  const auto is = [](Sign sign) { return [sign](Sign other) { return other == sign; }; };
  const bool apart = std::any_of(sides.begin(), sides.end(), is(Sign::negative)) &&
                     std::any_of(sides.begin(), sides.end(), is(Sign::positive));
  if (apart) return false;
  const bool in_line = std::all_of(sides.begin(), sides.end(), is(Sign::zero));
  return !in_line || is_between(p, a, b) || is_between(p, b, c) || is_between(p, c, a);
}

/// Exact. Points of one plane, and so their projections along all three axes: features meet if all three do, since not all lose what they
/// are projected from.
bool meet_at_start(const RotationQuery& query) {
  const auto& [a, b, c, d] = query.points;
  if (condyle::core::exact::orientation(vec3(a), vec3(b), vec3(c), vec3(d)) != Sign::zero) return false;
  for (int without = 0; without < 3; ++without) {
    const Flat p = flat(a, without), q = flat(b, without), r = flat(c, without), s = flat(d, without);
    const bool meet = query.features == RotationQuery::Features::vertex_face ? point_in_triangle(p, q, r, s)
                                                                             : segments_meet(p, q, r, s);
    if (!meet) return false;
  }
  return true;
}

// ---- During the motion ----

/// Rounding of the two angles that a query starts and ends at, and of their difference.
constexpr double rounding_of_ends = 4e-15;

bool is_within(const ContactEvent& event, const RotationQuery& query) {
  return query.is_whole_turn || event.angle - event.error <= query.angle + rounding_of_ends;
}

using FirstAngle = std::optional<double>;

void take(double angle, FirstAngle& first) {
  first = std::min(angle, first.value_or(angle));
}

void take_all(const ContactEvents& events, const RotationQuery& query, FirstAngle& first) {
  for (const ContactEvent& e : events)
    if (is_within(e, query)) take(e.angle, first);
}

Point along(const Point& p, const Point& direction, double times) {
  return {p.x + times * direction.x, p.y + times * direction.y, p.z + times * direction.z};
}

/// Edges that may be parallel at some angle: as steep as each other, or nearly.
bool may_be_parallel(const Point& u, const Point& w) {
  const double first = u.z * u.z * dot(w, w), second = w.z * w.z * dot(u, u);
  return std::abs(first - second) <= 1e-9 * (first + second);
}

/// An edge from an end in some direction and one in the opposite direction both meet the other edge at one angle only if the end itself
/// does. Directions that stay in one plane with the other edge, or are parallel to it there, say nothing; not all of these do.
template <class Meet>
void take_end_on_edge(const Point& end, const RotationQuery& query, const Meet& edges_meet,
                      FirstAngle& first) {
  for (const Point& direction : {Point{1, 0, 0}, Point{0, 1, 0}, Point{0, 0, 1}, Point{1, 1, 1}}) {
    const ContactEvents ahead = edges_meet(end, along(end, direction, 1));
    if (ahead.count == 0) continue;
    const ContactEvents behind = edges_meet(end, along(end, direction, -1));
    for (const ContactEvent& e : ahead)
      for (const ContactEvent& f : behind)
        if (std::abs(e.angle - f.angle) <= e.error + f.error && is_within(e, query)) take(e.angle, first);
  }
}

void take_parallel_edges(const RotationQuery& query, FirstAngle& first) {
  const auto& [a, b, c, d] = query.points;
  if (!may_be_parallel(b - a, d - c)) return;
  const Point p = a, q = b, r = c, s = d;  // clang captures no structured bindings
  const auto on_resting = [&](const Point& from, const Point& to) {
    return condyle::motion::edges_meet(from, to, r, s);
  };
  const auto on_turning = [&](const Point& from, const Point& to) {
    return condyle::motion::edges_meet(p, q, from, to);
  };
  take_end_on_edge(p, query, on_resting, first);
  take_end_on_edge(q, query, on_resting, first);
  take_end_on_edge(r, query, on_turning, first);
  take_end_on_edge(s, query, on_turning, first);
}

}  // namespace

std::optional<double> first_contact_by_events(const RotationQuery& query) {
  if (meet_at_start(query)) return 0;
  const auto& [a, b, c, d] = query.points;
  FirstAngle first;
  if (query.features == RotationQuery::Features::edge_edge) {
    take_all(condyle::motion::edges_meet(a, b, c, d), query, first);
    take_parallel_edges(query, first);
    return first;
  }
  take_all(condyle::motion::vertex_meets_face(a, {b, c, d}), query, first);
  // In the plane of a face across the axis all the way: where it passes an edge.
  if (a.z == b.z && b.z == c.z && c.z == d.z) {
    take_all(condyle::motion::edges_meet(a, a, b, c), query, first);
    take_all(condyle::motion::edges_meet(a, a, c, d), query, first);
    take_all(condyle::motion::edges_meet(a, a, d, b), query, first);
  }
  return first;
}

}  // namespace bench
