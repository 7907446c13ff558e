#include <algorithm>
#include <array>
#include <cmath>

#include "core/trigonometry.hpp"
#include "rotations/rotation_methods.hpp"

namespace bench {
namespace {

using condyle::motion::cross;
using condyle::motion::dot;
using Points = std::array<Point, 4>;

Point mixed(const Point& a, const Point& b, double share) {
  return {a.x + share * (b.x - a.x), a.y + share * (b.y - a.y), a.z + share * (b.z - a.z)};
}

double length(const Point& v) {
  return std::sqrt(dot(v, v));
}

/// The query's points after a turn.
Points at(const RotationQuery& query, double angle) {
  const auto [sine, cosine] = condyle::core::sine_cosine(angle);
  Points points = query.points;
  for (std::size_t i = 0; i < query.turning(); ++i) {
    const Point& p = query.points[i];
    points[i] = {p.x * cosine - p.y * sine, p.x * sine + p.y * cosine, p.z};
  }
  return points;
}

double to_segment(const Point& p, const Point& a, const Point& b) {
  const Point u = b - a;
  const double square = dot(u, u);
  const double share = square > 0 ? std::clamp(dot(p - a, u) / square, 0.0, 1.0) : 0;
  return length(p - mixed(a, b, share));
}

/// Whether the foot of p on the triangle's plane is inside.
bool is_over(const Point& p, const Point& a, const Point& b, const Point& c, const Point& normal) {
  return dot(cross(b - a, p - a), normal) >= 0 && dot(cross(c - b, p - b), normal) >= 0 &&
         dot(cross(a - c, p - c), normal) >= 0;
}

double to_triangle(const Point& p, const Point& a, const Point& b, const Point& c) {
  const Point normal = cross(b - a, c - a);
  const double size = length(normal);
  if (size > 0 && is_over(p, a, b, c, normal)) return std::abs(dot(p - a, normal)) / size;
  return std::min({to_segment(p, a, b), to_segment(p, b, c), to_segment(p, c, a)});
}

/// Shares of the edges at which their lines are nearest; outside of [0, 1] for parallel ones.
std::array<double, 2> nearest_shares(const Point& a, const Point& b, const Point& c, const Point& d) {
  const Point u = b - a, w = d - c, across = cross(u, w);
  const double square = dot(across, across);
  if (!(square > 0)) return {-1, -1};
  return {dot(cross(c - a, w), across) / square, dot(cross(c - a, u), across) / square};
}

bool are_on_both(const std::array<double, 2>& shares) {
  return shares[0] >= 0 && shares[0] <= 1 && shares[1] >= 0 && shares[1] <= 1;
}

double between_segments(const Point& a, const Point& b, const Point& c, const Point& d) {
  // Shares of lines that are nearly parallel are rounding: the ends are nearer then.
  const auto shares = nearest_shares(a, b, c, d);
  const double inside =
      are_on_both(shares) ? length(mixed(a, b, shares[0]) - mixed(c, d, shares[1])) : HUGE_VAL;
  return std::min(
      {inside, to_segment(a, c, d), to_segment(b, c, d), to_segment(c, a, b), to_segment(d, a, b)});
}

double distance(const RotationQuery& query, const Points& points) {
  const auto& [a, b, c, d] = points;
  return query.features == RotationQuery::Features::vertex_face ? to_triangle(a, b, c, d)
                                                                : between_segments(a, b, c, d);
}

/// Six times the volume of the four points: 0 if the features meet.
double volume(const Points& points) {
  const auto& [a, b, c, d] = points;
  return dot(cross(b - a, c - a), d - a);
}

/// Whether features whose points are in one plane meet, by rounded numbers.
bool meet_in_plane(const RotationQuery& query, const Points& points) {
  const auto& [a, b, c, d] = points;
  return query.features == RotationQuery::Features::vertex_face ? is_over(a, b, c, d, cross(c - b, d - b))
                                                                : are_on_both(nearest_shares(a, b, c, d));
}

}  // namespace

bool meet_by_chords(const RotationQuery& query, double step) {
  // Distances are of size 1, and known to 1e-15: this is what advancement ends at, lest it take for ever.
  constexpr double near = 1e-9;
  const auto steps = std::max<long>(1, std::lround(std::ceil(query.angle / step)));
  const double each = query.angle / static_cast<double>(steps);
  double radius = 0;
  for (std::size_t i = 0; i < query.turning(); ++i)
    radius = std::max(radius, std::hypot(query.points[i].x, query.points[i].y));
  const auto [sine, cosine] = condyle::core::sine_cosine(each / 4);
  const double strays = radius * 2 * sine * sine;  // r (1 - cos(each / 2))
  const double chord = radius * 4 * sine * cosine;
  Points from = query.points;
  for (long i = 1; i <= steps; ++i) {
    const Points to = at(query, static_cast<double>(i) * each);
    for (double share = 0; share <= 1;) {
      Points now = from;
      for (std::size_t k = 0; k < query.turning(); ++k) now[k] = mixed(from[k], to[k], share);
      const double free = distance(query, now) - strays;
      if (free <= near) return true;
      if (!(chord > 0)) break;
      share += free / chord;
    }
    from = to;
  }
  return false;
}

bool meet_by_samples(const RotationQuery& query, double step) {
  const auto steps = std::max<long>(1, std::lround(std::ceil(query.angle / step)));
  const double each = query.angle / static_cast<double>(steps);
  double before = volume(query.points);
  if (before == 0 && meet_in_plane(query, query.points)) return true;
  for (long i = 1; i <= steps; ++i) {
    double last = static_cast<double>(i) * each;
    const double after = volume(at(query, last));
    if (before * after <= 0) {
      double first = static_cast<double>(i - 1) * each;
      for (int halvings = 0; halvings < 50; ++halvings) {
        const double middle = 0.5 * (first + last);
        (before * volume(at(query, middle)) > 0 ? first : last) = middle;
      }
      if (meet_in_plane(query, at(query, last))) return true;
    }
    before = after;
  }
  return false;
}

}  // namespace bench
