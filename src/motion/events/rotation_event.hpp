#pragma once

#include <array>
#include <cmath>

#include "condyle/angle.hpp"
#include "condyle/pose.hpp"
#include "motion/events/rotation_function.hpp"

/// Contact events: the angles at which features of a rotating body meet features of a stationary one
/// (docs/mathematics/05-contact-under-rotation.md).
///
/// Everything here is in the axis frame: the axis is z, the rotation is R(t) about it, coordinates at t = 0.
/// The given doubles are taken as exact. Whether two features meet at a root is decided exactly, always: first
/// in double with an error bound, and where that is too close to call, in integers. No contact is missed and
/// none is invented.

namespace condyle::motion {

/// Which part of the full turn counts. Roots outside may be reported or not; the fast tests skip most of
/// them.
class AngleWindow {
 public:
  /// The full turn.
  AngleWindow() = default;
  /// Angles from 0 to `last` in the positive direction.
  static AngleWindow forward(double last) noexcept { return AngleWindow(last, 1.0); }
  /// Angles from 2 pi down to 2 pi - `last`: the same the other way.
  static AngleWindow backward(double last) noexcept { return AngleWindow(last, -1.0); }
  /// As seen when the rotation is reversed.
  AngleWindow mirrored() const noexcept {
    AngleWindow other = *this;
    other.side_ = -side_;
    return other;
  }

  /// Whether the angle with this cosine and sine, known to within `error`, may lie in the window: never false
  /// for one that does. Angles that may be just past the start always may.
  bool may_hold(double cosine, double sine, double error) const noexcept {
    const double slack = error + rounding_slack;
    return order(cosine, side_ * sine) <= last_ + slack || (cosine > 0 && std::abs(sine) <= slack);
  }

 private:
  AngleWindow(double last, double side) noexcept;

  /// Grows with the angle from 0 (at 0) to 4 (at 2 pi), without an arctangent.
  static double order(double cosine, double sine) noexcept { return sine >= 0 ? 1 - cosine : 3 + cosine; }

  /// Above every `order`.
  static constexpr double full_turn = 5;
  /// Above the rounding of cosines, sines and `order`; small enough to let hardly anything through.
  static constexpr double rounding_slack = 1e-14;

  double last_ = full_turn;
  double side_ = 1;
};

/// One angle at which two features meet, in [0, 2 pi]: angles just below zero are just below 2 pi (or 2 pi
/// itself once rounded), and which of the two it is is decided exactly. |angle - true angle| <= error.
struct ContactEvent {
  double angle = 0;
  double error = 0;
};

/// All angles of a full turn at which one pair of features meets: two at most; of edges that lie in one plane
/// across the axis eight (each of four ends passes the other edge twice).
struct ContactEvents {
  int count = 0;
  int exact_decisions = 0;
  std::array<ContactEvent, 8> event{};

  const ContactEvent* begin() const noexcept { return event.data(); }
  const ContactEvent* end() const noexcept { return event.data() + count; }
  void add(const ContactEvent& e) noexcept { event[static_cast<std::size_t>(count++)] = e; }
};

/// Bound on `ContactEvent::error`: roots worse than this in double are computed again from exact coefficients.
inline constexpr double worst_event_error = 1e-12;

using Corners = std::array<Triple<double>, 3>;

/// Angles t at which R(t) p lies on the closed triangle. Nothing for a triangle without area, and nothing
/// where p stays in the triangle's plane all the way (p on the axis, or the plane across the axis): the edges
/// around report that contact.
ContactEvents vertex_meets_face(const Triple<double>& p, const Corners& face, const AngleWindow& window = {});

/// Angles t at which q lies on the closed triangle turned by R(t).
ContactEvents face_meets_vertex(const Corners& face, const Triple<double>& q, const AngleWindow& window = {});

/// Angles t at which the closed edge a b turned by R(t) meets the closed edge c d.
///
/// Parallel at the root: reported by the end that lies on the other edge's faces (vertex_meets_face), not
/// here. Always in one plane (both parallel to the axis, both through one point of the axis, or two mirrored
/// rulings of one hyperboloid): not here for the same reason. Only where both lie in one plane across the
/// axis have flat open sheets no neighbour to report, and the ends passing the other edge are reported here.
ContactEvents edges_meet(const Triple<double>& a, const Triple<double>& b, const Triple<double>& c,
                         const Triple<double>& d, const AngleWindow& window = {});

}  // namespace condyle::motion
