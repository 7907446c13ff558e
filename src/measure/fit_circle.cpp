#include "measure/fit_circle.hpp"

#include <Eigen/Cholesky>
#include <algorithm>

#include <cmath>
#include <utility>

#include "condyle/angle.hpp"

namespace condyle::measure {
namespace {

/// mm: a step this short is none. Dropping settles in some twenty rounds.
constexpr double settled = 1e-10;
constexpr int most_steps = 50, most_rounds = 100;
/// Share of the contour that is kept: a cam of 90 degrees has 15 of the 210 that a head's circle is fitted to, the pit of the
/// ligament some 30.
constexpr double kept_share = 0.8;
/// As many parts are left out of a start in turn, and so many rounds show which start is best.
constexpr std::size_t starts = 4;
constexpr int first_rounds = 3;
/// Least determinant of the points' spread over its squared trace: an arc of 15 degrees.
constexpr double least_spread = 1e-5;

struct Weighted {
  Vec2 point;
  double weight;
};

/// The middles of parts of each piece that are short beside what is dropped, so that the share does not depend on the triangles.
std::vector<Weighted> weighted(const Contour& pieces) {
  constexpr double longest_mm = 0.5;
  std::vector<Weighted> points;
  for (const ContourPiece& piece : pieces) {
    const Vec2 along = piece.to - piece.from;
    const double length = along.norm(), parts = std::max(1.0, std::ceil(length / longest_mm));
    for (double i = 0; i < parts; ++i)
      points.push_back({piece.from + (i + 0.5) / parts * along, length / parts});
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

/// One of Gauss and Newton's steps on the sum of squared distances; its length, or none if the points leave it open.
std::optional<double> take_step(const std::vector<Weighted>& points, Circle& circle) {
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
  circle.centre += change.head<2>(), circle.radius += change.z();
  if (!circle.centre.allFinite() || !(circle.radius > 0)) return std::nullopt;
  return change.norm();
}

double residual(const Circle& circle, const Vec2& p) {
  return (p - circle.centre).norm() - circle.radius;
}

/// The points nearest to a circle that have the kept share of the weight: the last of them counts with what is left of it.
class Trimmed {
 public:
  explicit Trimmed(const std::vector<Weighted>& all) : all_(all), off_(all.size()) {
    for (const Weighted& one : all) kept_weight_ += kept_share * one.weight;
  }

  /// The mean of their squared distances.
  double keep(const Circle& circle) {
    for (std::size_t i = 0; i < all_.size(); ++i)
      off_[i] = {std::abs(residual(circle, all_[i].point)), static_cast<Index>(i)};
    std::sort(off_.begin(), off_.end());
    kept_.clear();
    double left = kept_weight_, squares = 0;
    for (const auto& [distance, i] : off_) {
      const double weight = std::min(all_[i].weight, left);
      if (!(weight > 0)) break;
      kept_.push_back({all_[i].point, weight});
      left -= weight, squares += weight * distance * distance;
    }
    return squares / kept_weight_;
  }
  const std::vector<Weighted>& kept() const noexcept { return kept_; }
  double weight() const noexcept { return kept_weight_; }

 private:
  const std::vector<Weighted>& all_;
  std::vector<std::pair<double, Index>> off_;
  std::vector<Weighted> kept_;
  double kept_weight_ = 0;
};

/// Circles to start from: of all points, and without each quarter of them as they lie around their middle.
std::vector<Circle> starts_of(const std::vector<Weighted>& all) {
  std::vector<Circle> out;
  const auto whole = algebraic(all);
  if (!whole) return out;
  out.push_back(*whole);
  for (std::size_t skipped = 0; skipped < starts; ++skipped) {
    std::vector<Weighted> some;
    for (const Weighted& one : all) {
      const Vec2 ray = one.point - whole->centre;
      const double turn = std::atan2(std::abs(ray.y()), -ray.x()) / (two_pi / 2);  // the same on both sides
      if (std::min(static_cast<std::size_t>(turn * starts), starts - 1) != skipped) some.push_back(one);
    }
    if (const auto circle = algebraic(some)) out.push_back(*circle);
  }
  return out;
}

}  // namespace

std::optional<CircleFit> fit_circle(const Contour& pieces) {
  const std::vector<Weighted> all = weighted(pieces);
  Trimmed trimmed(all);
  std::optional<Circle> best;
  double least = 0;
  for (Circle circle : starts_of(all)) {
    for (int round = 0; round < first_rounds; ++round) {
      trimmed.keep(circle);
      if (!take_step(trimmed.kept(), circle)) return std::nullopt;
    }
    const double squares = trimmed.keep(circle);
    if (!best || squares < least) best = circle, least = squares;
  }
  if (!best) return std::nullopt;
  for (int round = 0; round < most_rounds; ++round) {
    trimmed.keep(*best);
    const auto step = take_step(trimmed.kept(), *best);
    if (!step) return std::nullopt;
    if (*step < settled) break;
  }
  return CircleFit{*best, std::sqrt(trimmed.keep(*best)), trimmed.weight()};
}

std::optional<Circle> circle_through(const std::vector<Vec2>& points) {
  std::vector<Weighted> all;
  for (const Vec2& p : points) all.push_back({p, 1});
  std::optional<Circle> circle = algebraic(all);
  for (int step = 0; circle && step < most_steps; ++step) {
    const auto length = take_step(all, *circle);
    if (!length) return std::nullopt;
    if (*length < settled) break;
  }
  return circle;
}

}  // namespace condyle::measure
