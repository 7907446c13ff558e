#include "measure/fit_circle.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "condyle/angle.hpp"
#include "condyle/fit.hpp"
#include "core/symmetric.hpp"
#include "core/trigonometry.hpp"

namespace condyle::measure {
namespace {

/// mm: a step this short is none. Dropping settles in some twenty rounds.
constexpr double settled = 1e-10;
constexpr int most_steps = 50, most_rounds = 100;
/// The distance at which the kept share ends is found to this, mm.
constexpr double same_mm = 1e-12;
constexpr int most_halvings = 60;
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

/// A part of a contour, so short that the distance from a circle is linear along it, to some micrometres.
struct Part {
  Vec2 from, to;
  double length;

  Vec2 at(double share) const { return from + share * (to - from); }
};

std::vector<Part> parts_of(const Contour& pieces, double head_radius) {
  const double longest = by_head(0.5, head_radius);  // mm
  std::vector<Part> parts;
  for (const ContourPiece& piece : pieces) {
    const Vec2 along = piece.to - piece.from;
    const double length = along.norm(), count = std::max(1.0, std::ceil(length / longest));
    for (double i = 0; i < count; ++i)
      parts.push_back({piece.from + i / count * along, piece.from + (i + 1) / count * along, length / count});
  }
  return parts;
}

std::vector<Weighted> middles(const std::vector<Part>& parts) {
  std::vector<Weighted> points;
  for (const Part& part : parts) points.push_back({part.at(0.5), part.length});
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
  const Vec3 change = core::solved(A, b);
  circle.centre += change.head<2>(), circle.radius += change.z();
  if (!circle.centre.allFinite() || !(circle.radius > 0)) return std::nullopt;
  return change.norm();
}

double residual(const Circle& circle, const Vec2& p) {
  return (p - circle.centre).norm() - circle.radius;
}

/// The parts of a contour nearest to a circle, with the kept share of its length. Parts are cut where they leave the share, so that it does
/// not depend on where they begin.
class Trimmed {
 public:
  Trimmed(const std::vector<Part>& all, double head_radius)
      : all_(all), off_(all.size()), same_(by_head(same_mm, head_radius)) {
    for (const Part& part : all) kept_length_ += kept_share * part.length;
  }

  /// The mean of the squared distances.
  double keep(const Circle& circle) {
    for (std::size_t i = 0; i < all_.size(); ++i)
      off_[i] = {residual(circle, all_[i].from), residual(circle, all_[i].to)};
    const double most = farthest_kept();
    kept_.clear();
    double squares = 0;
    for (std::size_t i = 0; i < all_.size(); ++i) {
      const auto [first, last] = within(off_[i], most);
      const double weight = (last - first) * all_[i].length;
      if (!(weight > 0)) continue;
      kept_.push_back({all_[i].at((first + last) / 2), weight});
      const double a = off_[i].at(first), b = off_[i].at(last);
      squares += weight * (a * a + a * b + b * b) / 3;
    }
    return squares / kept_length_;
  }
  const std::vector<Weighted>& kept() const noexcept { return kept_; }
  double length() const noexcept { return kept_length_; }

 private:
  /// Distances from the circle at both ends of a part, below 0 inside.
  struct Off {
    double from, to;

    double at(double share) const { return from + share * (to - from); }
  };

  /// Between which shares of the way along a part it is no farther off.
  static std::pair<double, double> within(const Off& off, double most) {
    const double rise = off.to - off.from;
    if (rise == 0) return std::abs(off.from) <= most ? std::pair(0.0, 1.0) : std::pair(0.0, 0.0);
    double first = (-most - off.from) / rise, last = (most - off.from) / rise;
    if (first > last) std::swap(first, last);
    return {std::clamp(first, 0.0, 1.0), std::clamp(last, 0.0, 1.0)};
  }

  struct Within {
    double length = 0, rise = 0;  ///< and by how much that grows with the distance
  };

  Within length_within(double most) const {
    Within sum;
    for (std::size_t i = 0; i < all_.size(); ++i) {
      const auto [first, last] = within(off_[i], most);
      sum.length += (last - first) * all_[i].length;
      if (!(last > first)) continue;
      const int cut = (first > 0) + (last < 1);
      if (cut > 0) sum.rise += cut * all_[i].length / std::abs(off_[i].to - off_[i].from);
    }
    return sum;
  }

  /// The length within a distance is made of straight lines: Newton's steps from where the last circle had it, or halves.
  double farthest_kept() {
    double low = 0, high = 0;
    for (const Off& off : off_) high = std::max({high, std::abs(off.from), std::abs(off.to)});
    double at = farthest_ > 0 && farthest_ < high ? farthest_ : high / 2;
    for (int i = 0; i < most_halvings && high - low > same_; ++i) {
      const Within sum = length_within(at);
      (sum.length < kept_length_ ? low : high) = at;
      const double step = sum.rise > 0 ? (kept_length_ - sum.length) / sum.rise : HUGE_VAL;
      if (std::abs(step) <= same_) break;
      at = at + step > low && at + step < high ? at + step : (low + high) / 2;
    }
    return farthest_ = at;
  }

  const std::vector<Part>& all_;
  std::vector<Off> off_;
  std::vector<Weighted> kept_;
  double kept_length_ = 0, farthest_ = 0;
  double same_;
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
      const double turn =
          core::arctangent(std::abs(ray.y()), -ray.x()) / (two_pi / 2);  // the same on both sides
      if (std::min(static_cast<std::size_t>(turn * starts), starts - 1) != skipped) some.push_back(one);
    }
    if (const auto circle = algebraic(some)) out.push_back(*circle);
  }
  return out;
}

}  // namespace

std::optional<CircleFit> fit_circle(const Contour& pieces, double head_radius) {
  const std::vector<Part> parts = parts_of(pieces, head_radius);
  Trimmed trimmed(parts, head_radius);
  std::optional<Circle> best;
  double least = 0;
  for (Circle circle : starts_of(middles(parts))) {
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
    if (*step < by_head(settled, head_radius)) break;
  }
  return CircleFit{*best, std::sqrt(trimmed.keep(*best)), trimmed.length()};
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
