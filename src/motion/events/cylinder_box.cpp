#include "motion/events/cylinder_box.hpp"

#include "core/predicates.hpp"
#include "core/trigonometry.hpp"

namespace condyle::motion {
namespace {

/// More than the roundings of a square root of a sum of three squares, relative.
constexpr double relative_slack = 8 * core::rounding_unit;
/// More than the roundings of an arctangent and of the few sums of angles made of it, in radians.
constexpr double angle_slack = 1e-14;
/// Corners this close to opposite each other about the axis, in radians, count as having it between them.
constexpr double opposite_slack = 1e-9;

double square(double a) noexcept {
  return a * a;
}

/// A lower bound on the distance to the nearest point of a triangle or an edge, of which the nearest and the
/// farthest corner and the square of the longest edge are known. Let p be the nearest point. At a corner:
/// nothing to do. In the inside of an edge p is a foot, |corner|^2 = |p|^2 + |corner - p|^2, and the nearer
/// end is at most half the edge away: |p|^2 >= min^2 - longest^2 / 4. In the inside of a triangle the same
/// with the nearest corner, at most the longest edge over sqrt(3) away: a third. The roundings of the squares
/// are at most 16 u max^2.
double nearest(double min, double max, double longest_squared, double fraction) noexcept {
  const double squared = square(min) - fraction * longest_squared - 16 * core::rounding_unit * square(max);
  return squared > 0 ? std::sqrt(squared) * (1 - relative_slack) : 0;
}
constexpr double edge_fraction = 1.0 / 4, face_fraction = 1.0 / 3;

double squared_distance_xy(const Triple<double>& a, const Triple<double>& b) noexcept {
  return square(b.x - a.x) + square(b.y - a.y);
}

struct Arc {
  double start, width;
};
constexpr Arc full_turn{0, two_pi};

/// Difference of two directions by the shorter arc, in (-pi, pi].
double difference(double from, double to) noexcept {
  const double angle = wrapped(to - from);
  return angle > std::numbers::pi ? angle - two_pi : angle;
}

/// Covers three directions within half a turn of one another; the full turn where they are not.
Arc arc_of(double a, double b, double c) noexcept {
  const double to_b = difference(a, b), to_c = difference(a, c);
  const double low = std::min({0.0, to_b, to_c}), high = std::max({0.0, to_b, to_c});
  if (high - low >= std::numbers::pi - opposite_slack) return full_turn;
  return {wrapped(a + low) - angle_slack, high - low + 2 * angle_slack};
}

}  // namespace

CylinderPoint cylinder_point(const Triple<double>& p) noexcept {
  const double rho2 = square(p.x) + square(p.y);
  return {std::sqrt(rho2), wrapped(core::arctangent(p.y, p.x)), std::sqrt(rho2 + square(p.z))};
}

CylinderBox box_of_vertex(const Triple<double>& p, const CylinderPoint& at) noexcept {
  const bool on_axis = p.x == 0 && p.y == 0;
  return {at.rho * (1 - relative_slack),
          at.rho * (1 + relative_slack),
          p.z,
          p.z,
          at.r * (1 - relative_slack),
          at.r * (1 + relative_slack),
          on_axis ? full_turn.start : at.theta - angle_slack,
          on_axis ? full_turn.width : 2 * angle_slack};
}

CylinderBox box_of_edge(const Triple<double>& a, const CylinderPoint& at_a, const Triple<double>& b,
                        const CylinderPoint& at_b) noexcept {
  const auto [rho_min, rho_max] = std::minmax({at_a.rho, at_b.rho});
  const auto [r_min, r_max] = std::minmax({at_a.r, at_b.r});
  const auto [z_min, z_max] = std::minmax({a.z, b.z});
  const double flat2 = squared_distance_xy(a, b), full2 = flat2 + square(b.z - a.z);
  const Arc arc = rho_min > 0 ? arc_of(at_a.theta, at_b.theta, at_b.theta) : full_turn;
  return {
      nearest(rho_min, rho_max, flat2, edge_fraction), rho_max * (1 + relative_slack), z_min,     z_max,
      nearest(r_min, r_max, full2, edge_fraction),     r_max * (1 + relative_slack),   arc.start, arc.width};
}

CylinderBox box_of_triangle(const Triple<double>& a, const CylinderPoint& at_a, const Triple<double>& b,
                            const CylinderPoint& at_b, const Triple<double>& c,
                            const CylinderPoint& at_c) noexcept {
  const auto [rho_min, rho_max] = std::minmax({at_a.rho, at_b.rho, at_c.rho});
  const auto [r_min, r_max] = std::minmax({at_a.r, at_b.r, at_c.r});
  const auto [z_min, z_max] = std::minmax({a.z, b.z, c.z});
  const double ab = squared_distance_xy(a, b), bc = squared_distance_xy(b, c), ca = squared_distance_xy(c, a);
  const double full2 = std::max({ab + square(b.z - a.z), bc + square(c.z - b.z), ca + square(a.z - c.z)});
  const Arc arc = rho_min > 0 ? arc_of(at_a.theta, at_b.theta, at_c.theta) : full_turn;
  const bool holds_axis = arc.width == full_turn.width;
  return {holds_axis ? 0 : nearest(rho_min, rho_max, std::max({ab, bc, ca}), edge_fraction),
          rho_max * (1 + relative_slack),
          z_min,
          z_max,
          nearest(r_min, r_max, full2, face_fraction),
          r_max * (1 + relative_slack),
          arc.start,
          arc.width};
}

CylinderBox box_of_box(const Triple<double>& centre, const Triple<double>& half) noexcept {
  const CylinderPoint at = cylinder_point(centre);
  // The radii of the circle and of the ball about the box, and the centre's own rounding.
  const double flat2 = square(half.x) + square(half.y), slack = 2 * relative_slack;
  const double reach = std::sqrt(flat2) * (1 + slack) + slack * at.rho;
  const double ball = std::sqrt(flat2 + square(half.z)) * (1 + slack) + slack * at.r;
  const double lift = half.z * (1 + slack) + slack * at.r;
  CylinderBox box{std::max(0.0, at.rho - reach), at.rho + reach, centre.z - lift, centre.z + lift,
                  std::max(0.0, at.r - ball),    at.r + ball,    full_turn.start, full_turn.width};
  // Seen from the axis the circle covers asin(reach / rho) on either side.
  if (reach < at.rho) {
    const double half_arc = core::arcsine(reach / at.rho) * (1 + relative_slack) + opposite_slack;
    box.theta = wrapped(at.theta - half_arc);
    box.theta_width = 2 * half_arc + angle_slack;
  }
  return box;
}

CylinderBox hull(const CylinderBox& a, const CylinderBox& b) noexcept {
  const auto from = [](const CylinderBox& first, const CylinderBox& second) {
    const double width =
        std::max(first.theta_width, wrapped(second.theta - first.theta) + second.theta_width);
    return Arc{first.theta, width + angle_slack};
  };
  const Arc ab = from(a, b), ba = from(b, a);
  Arc arc = ab.width <= ba.width ? ab : ba;
  if (arc.width >= two_pi) arc = full_turn;
  return {std::min(a.rho_lo, b.rho_lo),
          std::max(a.rho_hi, b.rho_hi),
          std::min(a.z_lo, b.z_lo),
          std::max(a.z_hi, b.z_hi),
          std::min(a.r_lo, b.r_lo),
          std::max(a.r_hi, b.r_hi),
          arc.start,
          arc.width};
}

}  // namespace condyle::motion
