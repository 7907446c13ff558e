#include "measure/fit_circle.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace condyle::measure {
namespace {

constexpr int most_steps = 50, most_rounds = 12;
/// mm: a step this short is none.
constexpr double settled = 1e-10;
/// Share of the contour that is kept: a cam of 90 degrees has 15 of the 210 that a head's circle is fitted to, the pit of the
/// ligament some 30.
constexpr double kept_share = 0.8;
/// Of the radius: what is nearer to the circle is never dropped, the rounding of coordinates in floats.
constexpr double narrowest_band = 1e-6;
/// Least determinant of the points' spread over its squared trace: an arc of 15 degrees.
constexpr double least_spread = 1e-5;

struct Weighted {
  Vec2 point;
  double weight;
};

/// Gauss's two points on each piece.
std::vector<Weighted> weighted(const Contour& pieces) {
  constexpr double place = 0.21132486540518712;  // (1 - 1 / sqrt 3) / 2
  std::vector<Weighted> points;
  for (const ContourPiece& piece : pieces) {
    const Vec2 along = piece.to - piece.from;
    const double half_length = along.norm() / 2;
    points.push_back({piece.from + place * along, half_length});
    points.push_back({piece.to - place * along, half_length});
  }
  return points;
}

/// |p|^2 = 2 c.p + k, linear: a start (Kasa 1976).
std::optional<Circle> algebraic(const std::vector<Weighted>& points) {
  double sum = 0;
  Vec2 mean = Vec2::Zero();
  for (const auto& [p, w] : points) sum += w, mean += w * p;
  if (!(sum > 0)) return std::nullopt;
  mean /= sum;
  Eigen::Matrix2d A = Eigen::Matrix2d::Zero();
  Vec2 b = Vec2::Zero();
  double square = 0;
  for (const auto& [p, w] : points) {
    const Vec2 q = p - mean;
    A += w * q * q.transpose(), b += w * q.squaredNorm() * q, square += w * q.squaredNorm();
  }
  const double det = A.determinant(), trace = A.trace();
  if (!(det > least_spread * trace * trace)) return std::nullopt;
  const Vec2 c = A.inverse() * b / 2;
  return Circle{mean + c, std::sqrt(c.squaredNorm() + square / sum)};
}

/// Gauss and Newton's steps on the sum of squared distances.
std::optional<Circle> geometric(const std::vector<Weighted>& points, Circle circle) {
  for (int step = 0; step < most_steps; ++step) {
    Eigen::Matrix3d A = Eigen::Matrix3d::Zero();
    Vec3 b = Vec3::Zero();
    for (const auto& [p, w] : points) {
      const Vec2 ray = p - circle.centre;
      const double distance = ray.norm();
      if (!(distance > 0)) continue;
      const Vec3 row(ray.x() / distance, ray.y() / distance, 1);
      A += w * row * row.transpose(), b += w * (distance - circle.radius) * row;
    }
    const Vec3 change = A.ldlt().solve(b);
    if (!change.allFinite()) return std::nullopt;
    circle.centre += change.head<2>(), circle.radius += change.z();
    if (change.norm() < settled) break;
  }
  if (!(circle.radius > 0) || !circle.centre.allFinite()) return std::nullopt;
  return circle;
}

double residual(const Circle& circle, const Vec2& p) {
  return (p - circle.centre).norm() - circle.radius;
}

/// So much of the weight has a smaller value.
double weighted_quantile(std::vector<std::pair<double, double>> values, double q) {
  std::sort(values.begin(), values.end());
  double all = 0, below = 0;
  for (const auto& value : values) all += value.second;
  for (const auto& value : values) {
    below += value.second;
    if (below >= q * all) return value.first;
  }
  return 0;
}

/// The distance from the circle within which the kept share lies.
double band_of(const std::vector<Weighted>& points, const Circle& circle) {
  std::vector<std::pair<double, double>> off;
  for (const auto& [p, w] : points) off.emplace_back(std::abs(residual(circle, p)), w);
  return std::max(weighted_quantile(std::move(off), kept_share), narrowest_band * circle.radius);
}

}  // namespace

std::optional<CircleFit> fit_circle(const Contour& pieces) {
  const std::vector<Weighted> all = weighted(pieces);
  std::vector<Weighted> kept = all;
  std::optional<Circle> circle = algebraic(all);
  for (int round = 0; circle && round < most_rounds; ++round) {
    circle = geometric(kept, *circle);
    if (!circle) return std::nullopt;
    const double band = band_of(all, *circle);
    std::vector<Weighted> next;
    for (const Weighted& one : all)
      if (std::abs(residual(*circle, one.point)) <= band) next.push_back(one);
    if (next.size() == kept.size()) break;
    kept = std::move(next);
  }
  if (!circle) return std::nullopt;
  double length = 0, squares = 0;
  for (const auto& [p, w] : kept) length += w, squares += w * residual(*circle, p) * residual(*circle, p);
  if (!(length > 0)) return std::nullopt;
  return CircleFit{*circle, std::sqrt(squares / length), length};
}

std::optional<Circle> circle_through(const std::vector<Vec2>& points) {
  std::vector<Weighted> all;
  for (const Vec2& p : points) all.push_back({p, 1});
  const auto start = algebraic(all);
  return start ? geometric(all, *start) : std::nullopt;
}

}  // namespace condyle::measure
