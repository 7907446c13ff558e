#include "motion/events/exact_event.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>

#include "core/exact_integers.hpp"
#include "core/trigonometry.hpp"
#include "motion/events/wrapped_angle.hpp"

namespace condyle::motion::exact {
namespace {

using core::exact::Integer;
using core::exact::sign_of;
using core::exact::to_integers;

using Point = Triple<Integer>;
using Function = RotationFunction<Integer>;

/// The points as integers with one common scale; every function below is homogeneous in them.
template <std::size_t N>
std::array<Point, N> integers(const std::array<Triple<double>, N>& points) {
  std::array<double, 3 * N> flat{};
  for (std::size_t i = 0; i < N; ++i) {
    flat[3 * i] = points[i].x, flat[3 * i + 1] = points[i].y, flat[3 * i + 2] = points[i].z;
  }
  const auto numbers = to_integers(flat);
  std::array<Point, N> out;
  for (std::size_t i = 0; i < N; ++i) out[i] = {numbers[3 * i], numbers[3 * i + 1], numbers[3 * i + 2]};
  return out;
}

int bits(const Integer& value) {
  return value == 0 ? 0 : static_cast<int>(msb(Integer(abs(value)))) + 1;
}
double shifted(const Integer& value, int shift) {
  return static_cast<double>(Integer(value >> static_cast<unsigned>(shift)));
}

/// Largest number of bits handed to double arithmetic; 2^1023 is the end of its range and squares are not
/// taken.
constexpr int safe_bits = 900;

/// Two roundings in each arctangent's arguments, its own, and those of the sum and of the full turn, each at
/// most half a unit in the last place of 2 pi.
constexpr double exact_event_error = 4e-15;

/// One root of T, with r^2 = A^2 + B^2 and D = r^2 - C^2 = S^2:
///
///     cos t = (-A C -+ B S) / r^2,   sin t = (-B C +- A S) / r^2
///
/// so that any other T'(t), times r^2, is P +- Q S with the integers
///
///     P = C' r^2 - C (A A' + B B'),   Q = A B' - B A'.
class Root {
 public:
  Root(const Function& T, Branch branch)
      : T_(T), r2_(T.A * T.A + T.B * T.B), D_(r2_ - T.C * T.C), branch_(static_cast<int>(branch)) {}

  /// A double root (D = 0) is reported once, by the plus branch; r = 0 never.
  bool exists() const { return r2_ != 0 && (D_ > 0 || (D_ == 0 && branch_ > 0)); }

  core::Sign sign_of_other(const Function& other) const {
    const Integer P = other.C * r2_ - T_.C * (T_.A * other.A + T_.B * other.B);
    const Integer Q = branch_ * (T_.A * other.B - T_.B * other.A);
    const core::Sign p = sign_of(P), q = D_ == 0 ? core::Sign::zero : sign_of(Q);
    if (p == q || q == core::Sign::zero) return p;
    if (p == core::Sign::zero) return q;
    const int larger = Integer(P * P).compare(Integer(Q * Q * D_));
    return larger == 0 ? core::Sign::zero : larger > 0 ? p : q;
  }

  ContactEvent event() const {
    const int r_shift = std::max(0, std::max(bits(T_.A), bits(T_.B)) - safe_bits);
    const int s_shift = std::max(0, std::max(bits(T_.C), bits(D_) / 2) - safe_bits / 2);
    const double S = std::sqrt(shifted(D_, 2 * s_shift));
    const double middle = core::arctangent(shifted(T_.B, r_shift), shifted(T_.A, r_shift));
    double angle = wrapped(middle + branch_ * core::arctangent(S, -shifted(T_.C, s_shift)));
    // On which side of the start a root next to it lies must not depend on rounding.
    const double from_start = std::min(angle, two_pi - angle);
    if (from_start < worst_event_error) {
      const core::Sign side = sign_of_other({0, 1, 0});
      const bool agrees = (angle < 1) == (side == core::Sign::positive);
      const double size = agrees ? from_start : 0;
      angle = side == core::Sign::negative ? two_pi - size : side == core::Sign::zero ? 0 : size;
    }
    return {angle, exact_event_error};
  }

 private:
  Function T_;
  Integer r2_, D_;
  int branch_;
};

/// Signs of two quantities that must not be on one side: a pair of ends and the plane of another edge.
enum class Sides { apart, same, both_on };
Sides sides(core::Sign a, core::Sign b) {
  if (a == core::Sign::zero && b == core::Sign::zero) return Sides::both_on;
  return a == b ? Sides::same : Sides::apart;
}

/// On which sides of the line from c along w the ends a and b stand at the root, all being in one plane
/// there: the sides of the plane through that line and a direction outside their common plane. A direction
/// that happens to be inside it says `both_on`, and another is tried; all three axes are not in one plane.
/// Still `both_on`: the lines coincide.
template <class SideFunction>
Sides sides_of_line(const Root& root, const Point& preferred, const SideFunction& side) {
  for (const Point& direction : {preferred, Point{1, 0, 0}, Point{0, 1, 0}, Point{0, 0, 1}}) {
    const auto [of_a, of_b] = side(direction);
    const Sides found = sides(root.sign_of_other(of_a), root.sign_of_other(of_b));
    if (found != Sides::both_on) return found;
  }
  return Sides::both_on;
}

/// The direction with its largest component at 2^20 and whole numbers throughout: few digits keep the
/// integers short.
Triple<double> short_direction(const Triple<double>& d) {
  const double largest = std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)}), scale = 0x1p20 / largest;
  const Triple<double> whole = {std::round(d.x * scale), std::round(d.y * scale), std::round(d.z * scale)};
  // Zeros, values that are not finite, and values so small that the scale is not.
  if (!std::isfinite(whole.x + whole.y + whole.z)) return {1, 0, 0};
  return whole;
}
Point integer_direction(const Triple<double>& d) {
  const auto s = short_direction(d);
  return {static_cast<long long>(s.x), static_cast<long long>(s.y), static_cast<long long>(s.z)};
}

enum class Rotating { end, edge };

/// End p passing the edge from c to d, all in one plane across the axis.
void add_passes(const Point& p, const Point& c, const Point& d, Rotating rotating, ContactEvents& events) {
  const Point w = d - c, across{-w.y, w.x, 0};
  for (const Branch branch : {Branch::plus, Branch::minus}) {
    const Root root(height_over_plane(across, c, p), branch);
    if (!root.exists()) continue;
    ++events.exact_decisions;
    const core::Sign after_c = root.sign_of_other(height_over_plane(w, c, p));
    const core::Sign after_d = root.sign_of_other(height_over_plane(w, d, p));
    if (after_c == core::Sign::negative || after_d == core::Sign::positive) continue;
    ContactEvent event = root.event();
    if (rotating == Rotating::edge && event.angle != 0) event.angle = two_pi - event.angle;
    events.add(event);
  }
}

}  // namespace

ContactEvents vertex_meets_face(const Triple<double>& vertex, const Corners& face, Branch branch) {
  const auto points = integers<4>({vertex, face[0], face[1], face[2]});
  const Point& p = points[0];
  const Point normal = cross(points[2] - points[1], points[3] - points[1]);
  ContactEvents events;
  events.exact_decisions = 1;
  const Root root(height_over_plane(normal, points[1], p), branch);
  if (!root.exists()) return events;
  for (std::size_t k = 1; k <= 3; ++k) {
    const Point& from = points[k];
    const Point inwards = cross(normal, points[k % 3 + 1] - from);
    if (root.sign_of_other(height_over_plane(inwards, from, p)) == core::Sign::negative) return events;
  }
  events.add(root.event());
  return events;
}

ContactEvents edges_meet(const std::array<Triple<double>, 4>& ends, const Triple<double>& across,
                         const Triple<double>& across_rotating, Branch branch) {
  const auto points = integers<4>(ends);
  const Point &a = points[0], &b = points[1], &c = points[2], &d = points[3];
  const Point u = b - a, w = d - c;
  ContactEvents events;
  events.exact_decisions = 1;
  const Root root(volume_of_edges(a, u, c, w), branch);
  if (!root.exists()) return events;
  const Sides rotating_ends = sides_of_line(root, integer_direction(across), [&](const Point& direction) {
    const Point normal = cross(w, direction);
    return std::pair{height_over_plane(normal, c, a), height_over_plane(normal, c, b)};
  });
  if (rotating_ends != Sides::apart) return events;
  const Sides stationary_ends =
      sides_of_line(root, integer_direction(across_rotating), [&](const Point& direction) {
        const Point normal = cross(u, direction);
        return std::pair{reversed(height_over_plane(normal, a, c)),
                         reversed(height_over_plane(normal, a, d))};
      });
  if (stationary_ends == Sides::apart) events.add(root.event());
  return events;
}

ContactEvents edges_meet_in_plane(const std::array<Triple<double>, 4>& ends) {
  const auto points = integers<4>(ends);
  const Point &a = points[0], &b = points[1], &c = points[2], &d = points[3];
  ContactEvents events;
  add_passes(a, c, d, Rotating::end, events);
  add_passes(b, c, d, Rotating::end, events);
  add_passes(c, a, b, Rotating::edge, events);
  add_passes(d, a, b, Rotating::edge, events);
  return events;
}

}  // namespace condyle::motion::exact
