#pragma once

#include <array>
#include <cmath>

#include "condyle/angle.hpp"
#include "condyle/points.hpp"
#include "motion/events/turn_function.hpp"

/// The angles at which features of a turning body touch features of a resting one (docs/mathematics.md,
/// section 5).
///
/// Everything here is in the axis frame: the axis is z, the turn is R(t) about it, coordinates at t = 0. The
/// given doubles are taken as exact. Whether two features touch at a root is decided exactly, always: first
/// in double with an error bound, and where that is too close to call, in integers. No contact is missed and
/// none is invented.

namespace condyle::motion {

/// Up to two angles in [0, 2 pi).
struct Roots {
  int count = 0;
  std::array<double, 2> angle{};
};

/// Angles at which a turning point meets a plane, in [0, 2 pi); none, one (grazing) or two.
///
///        x(t)
///     . - o ~ ~ ~ ~ ~   plane  n.x = d
///   .    /    .
///  .    / t    .        x(t) = R(t) p about z
///  .   +---p---.
///
/// n.x(t) - d = A cos t + B sin t + C,  A = n_x p_x + n_y p_y,  B = n_y p_x - n_x p_y,  C = n_z p_z - d.
/// t = atan2(B, A) +- atan2(sqrt((r - C)(r + C)), -C),  r = hypot(A, B).
/// A circle lying in the plane (r = C = 0) reports nothing: neighbouring features find that contact.
/// The root moves by at most 2 E / S when A cos t + B sin t + C moves by at most E, as long as S^2 >= 8 r E,
/// with S = sqrt(r^2 - C^2) the slope at the root; nearer to grazing only by sqrt(E / r).
Roots rotation_roots(double A, double B, double C) noexcept;

/// Which part of the turn is asked for. Roots outside may be reported or not; the fast tests skip most of
/// them.
class TurnWindow {
 public:
  /// The whole turn.
  TurnWindow() = default;
  /// Angles from 0 to `last` in the positive direction.
  static TurnWindow forward(double last) noexcept { return TurnWindow(last, 1.0); }
  /// Angles from 2 pi down to 2 pi - `last`: the same the other way.
  static TurnWindow backward(double last) noexcept { return TurnWindow(last, -1.0); }
  /// As seen when the turn is reversed.
  TurnWindow mirrored() const noexcept {
    TurnWindow other = *this;
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
  TurnWindow(double last, double side) noexcept;

  /// Grows with the angle from 0 (at 0) to 4 (at 2 pi), without an arctangent.
  static double order(double cosine, double sine) noexcept { return sine >= 0 ? 1 - cosine : 3 + cosine; }

  /// Above every `order`.
  static constexpr double whole_turn = 5;
  /// Above the rounding of cosines, sines and `order`; small enough to let hardly anything through.
  static constexpr double rounding_slack = 1e-14;

  double last_ = whole_turn;
  double side_ = 1;
};

/// One angle at which two features touch, in [0, 2 pi]: angles just below zero are just below 2 pi (or 2 pi
/// itself once rounded), and which of the two it is is decided exactly. |angle - true angle| <= error.
struct Touch {
  double angle = 0;
  double error = 0;
};

/// All angles of a turn at which one pair of features touches. A pair meets at two at most; edges that lie in
/// one plane of the motion at eight (each of four ends passes the other edge twice).
struct Touches {
  int count = 0;
  int exact_decisions = 0;
  std::array<Touch, 8> touch{};

  const Touch* begin() const noexcept { return touch.data(); }
  const Touch* end() const noexcept { return touch.data() + count; }
  void add(const Touch& t) noexcept { touch[static_cast<std::size_t>(count++)] = t; }
};

/// Bound on `Touch::error`: roots worse than this in double are computed again from exact coefficients.
inline constexpr double worst_touch_error = 1e-12;

using Corners = std::array<Triple<double>, 3>;

/// Angles t at which R(t) p lies on the closed triangle. Nothing for a triangle without area, and nothing
/// where p stays in the triangle's plane all the way (p on the axis, or the plane across the axis): the edges
/// around report that contact.
Touches vertex_meets_face(const Triple<double>& p, const Corners& face, const TurnWindow& window = {});

/// Angles t at which q lies on the closed triangle turned by R(t).
Touches face_meets_vertex(const Corners& face, const Triple<double>& q, const TurnWindow& window = {});

/// Angles t at which the closed edge a b turned by R(t) touches the closed edge c d.
///
/// Parallel at the root: reported by the end that lies on the other edge's faces (vertex_meets_face), not
/// here. Always in one plane (both parallel to the axis, both through one point of the axis, or two mirrored
/// rulings of one hyperboloid): not here for the same reason. Only where both lie in one plane across the
/// axis have flat open sheets no neighbour to report, and the ends passing the other edge are reported here.
Touches edges_meet(const Triple<double>& a, const Triple<double>& b, const Triple<double>& c,
                   const Triple<double>& d, const TurnWindow& window = {});

}  // namespace condyle::motion
