#include "motion/events/rotation_event.hpp"

#include <algorithm>
#include <cmath>

#include "core/predicates.hpp"
#include "core/trigonometry.hpp"
#include "motion/events/exact_event.hpp"
#include "motion/events/wrapped_angle.hpp"

namespace condyle::motion {
namespace {

using Point = Triple<double>;
using exact::Branch;

/// Sum of sizes of the components: at least the length, and cheaper.
double size_of(const Point& a) noexcept {
  return (std::abs(a.x) + std::abs(a.y)) + std::abs(a.z);
}
/// At least the distance from the axis.
double off_axis(const Point& a) noexcept {
  return std::abs(a.x) + std::abs(a.y);
}

struct Direction {
  double cosine, sine;
};

Point turned(const Point& p, const Direction& t) noexcept {
  return {p.x * t.cosine - p.y * t.sine, p.x * t.sine + p.y * t.cosine, p.z};
}

/// Roots of a RotationFunction known to within `error` at every angle.
struct BoundedRoots {
  enum class State { none, two, unclear } state = State::none;
  Direction plus{}, minus{};
  /// Bound on the angle of either root, in radians.
  double error = 0;
};

/// Far above what coefficients lose where their products underflow, far below any that matter; its own square
/// is still a normal number.
constexpr double underflow = 0x1p-450;

/// Let |T^(t) - T(t)| <= E at all t. T^ has r^ and C^; where |C^| > r^ + E, T has no root. Where S^2 = r^2 -
/// C^2 >= 16 r E, each root t of T^ has exactly one of T within h = 2 E / S: with T^(t + h) = C (1 - cos h)
/// -+ S sin h, |T^(t +- h)| >= S sin h - r h^2 / 2 >= 1.97 E - 0.13 E > E, so T changes sign between, and the
/// two intervals are disjoint. Between lies grazing, left to exact arithmetic.
BoundedRoots bounded_roots(const RotationFunction<double>& T, double E) noexcept {
  const double r2 = T.A * T.A + T.B * T.B, r = std::sqrt(r2);
  // Forming S from r and C moves a root by less than 4 u r / S: as if E were this much larger.
  const double total = E + 8 * core::rounding_unit * r + underflow;
  if (std::abs(T.C) > r + total) return {};
  const double S2 = (r - T.C) * (r + T.C);
  if (!(S2 > 16 * r * total)) return {BoundedRoots::State::unclear, {}, {}, 0};
  const double S = std::sqrt(S2), scale = 1 / r2;
  return {BoundedRoots::State::two,
          {(-T.A * T.C - T.B * S) * scale, (-T.B * T.C + T.A * S) * scale},
          {(-T.A * T.C + T.B * S) * scale, (-T.B * T.C - T.A * S) * scale},
          2 * total / S + 8 * core::rounding_unit};
}

enum class Decision { no, yes, unclear };

/// Rounding of the arctangent and of adding the full turn.
constexpr double arctangent_error = 2e-15;

/// The root as an event, or nothing where exact arithmetic has to finish: too wide a bound, or next to the
/// start, where the side matters.
bool add_event(const Direction& root, double error, ContactEvents& events) noexcept {
  const double total = error + arctangent_error;
  const double angle = wrapped(core::arctangent(root.sine, root.cosine));
  if (total > worst_event_error || std::min(angle, two_pi - angle) < 2 * worst_event_error) return false;
  events.add({angle, total});
  return true;
}

void append(const ContactEvents& more, ContactEvents& events) noexcept {
  events.exact_decisions += more.exact_decisions;
  for (const ContactEvent& e : more) events.add(e);
}

/// Tests one root after the other: `inside(root, error)` says whether the features reach each other there,
/// `decide(branch, root)` decides the same exactly.
template <class Inside, class Decide>
ContactEvents events_at(const BoundedRoots& roots, const AngleWindow& window, const Inside& inside,
                        const Decide& decide) {
  ContactEvents events;
  if (roots.state == BoundedRoots::State::none) return events;
  for (const Branch branch : {Branch::plus, Branch::minus}) {
    const Direction& root = branch == Branch::plus ? roots.plus : roots.minus;
    if (roots.state == BoundedRoots::State::two) {
      if (!window.may_hold(root.cosine, root.sine, roots.error)) continue;
      const Decision decision = inside(root, roots.error);
      if (decision == Decision::no) continue;
      if (decision == Decision::yes && add_event(root, roots.error, events)) continue;
    }
    append(decide(branch, root), events);
  }
  return events;
}

void mirror(ContactEvents& events) noexcept {
  for (int i = 0; i < events.count; ++i) {
    double& angle = events.event[static_cast<std::size_t>(i)].angle;
    // An event exactly at the start stays there: it belongs to neither sense.
    if (angle != 0) angle = two_pi - angle;
  }
}

}  // namespace

AngleWindow::AngleWindow(double last, double side) noexcept : side_(side) {
  const auto [sine, cosine] = core::sine_cosine(last);
  last_ = last >= two_pi ? full_turn : order(cosine, sine);
}

ContactEvents vertex_meets_face(const Point& p, const Corners& face, const AngleWindow& window) {
  const Point &a = face[0], &b = face[1], &c = face[2];
  const bool face_across_axis = a.z == b.z && b.z == c.z, on_axis = p.x == 0 && p.y == 0;
  if (face_across_axis || on_axis) return {};
  const Point ab = b - a, ac = c - a, normal = cross(ab, ac);
  // |normal| in rounding: each component errs by 4 u of the products that make it.
  const double N = size_of(ab) * size_of(ac);
  // Three coefficients of products of two factors erring by 5 u N and u: 16 u covers them together.
  const double E = 16 * core::rounding_unit * N * ((off_axis(p) + off_axis(a)) + std::abs(p.z - a.z));
  const auto roots = bounded_roots(height_over_plane(normal, a, p), E);

  const auto inside = [&](const Direction& root, double error) {
    const Point x = turned(p, root);
    const double moved = off_axis(p) * (error + 4 * core::rounding_unit);
    Decision decision = Decision::yes;
    const auto side = [&](const Point& from, const Point& to) {
      const Point edge = to - from, arm = x - from;
      const double value = dot(cross(edge, arm), normal);
      const double bound = 2 * size_of(edge) * N * (moved + 16 * core::rounding_unit * size_of(arm));
      if (value < -bound) {
        decision = Decision::no;
      } else if (value <= bound && decision == Decision::yes) {
        decision = Decision::unclear;
      }
      return decision != Decision::no;
    };
    if (side(a, b) && side(b, c)) side(c, a);
    return decision;
  };
  const auto decide = [&](Branch branch, const Direction&) {
    return exact::vertex_meets_face(p, face, branch);
  };
  return events_at(roots, window, inside, decide);
}

ContactEvents face_meets_vertex(const Corners& face, const Point& q, const AngleWindow& window) {
  ContactEvents events = vertex_meets_face(q, face, window.mirrored());
  mirror(events);
  return events;
}

ContactEvents edges_meet(const Point& a, const Point& b, const Point& c, const Point& d,
                         const AngleWindow& window) {
  const Point u = b - a, w = d - c;
  if (u.x == 0 && u.y == 0 && w.x == 0 && w.y == 0) return {};
  if (a.z == b.z && b.z == c.z && c.z == d.z) return exact::edges_meet_in_plane({a, b, c, d});
  // Each term is a product of three factors, of which two err by u each, and sums of four: 9 u of its size,
  // in three coefficients whose terms sum to at most three times this.
  const double E = 32 * core::rounding_unit * size_of(u) * size_of(w) *
                   ((off_axis(a) + off_axis(c)) + std::abs(c.z - a.z));
  const auto roots = bounded_roots(volume_of_edges(a, u, c, w), E);

  // Across both edges at the root: with it, "between the ends" is a matter of sides of planes
  // (exact_event.cpp).
  const auto across_at = [&](const Direction& root) { return cross(turned(u, root), w); };
  const auto inside = [&](const Direction& root, double error) {
    const Direction back{root.cosine, -root.sine};
    const Point across = across_at(root), across_rotating = turned(across, back);
    const double slip = error + 4 * core::rounding_unit;
    const auto apart = [&](const Point& along, const Point& beside, const Point& origin, const Point& p,
                           const Point& q) {
      const Point normal = cross(along, beside), to_p = p - origin, to_q = q - origin;
      const double size = size_of(along) * size_of(beside);
      const double at_p = dot(normal, to_p), at_q = dot(normal, to_q);
      const double bound_p = 2 * size * (off_axis(p) * slip + 8 * core::rounding_unit * size_of(to_p));
      const double bound_q = 2 * size * (off_axis(q) * slip + 8 * core::rounding_unit * size_of(to_q));
      if (std::abs(at_p) <= bound_p || std::abs(at_q) <= bound_q) return Decision::unclear;
      return (at_p > 0) != (at_q > 0) ? Decision::yes : Decision::no;
    };
    const Decision rotating_ends = apart(w, across, c, turned(a, root), turned(b, root));
    if (rotating_ends == Decision::no) return Decision::no;
    const Decision stationary_ends = apart(u, across_rotating, a, turned(c, back), turned(d, back));
    if (stationary_ends == Decision::no) return Decision::no;
    return rotating_ends == stationary_ends ? rotating_ends : Decision::unclear;
  };
  const auto decide = [&](Branch branch, const Direction& root) {
    const Point across = across_at(root);
    return exact::edges_meet({a, b, c, d}, across, turned(across, {root.cosine, -root.sine}), branch);
  };
  return events_at(roots, window, inside, decide);
}

}  // namespace condyle::motion
