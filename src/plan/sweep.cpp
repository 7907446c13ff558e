#include "plan/sweep.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/trigonometry.hpp"

namespace condyle::plan {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();

struct Interval {
  double begin, end;
};

/// While a point turns by t about the axis it is farther than the radius from a centre at rest for cos(t - nearest) < bound, so
/// from `nearest + a` to `nearest + 2 pi - a`; empty if never. The interval begins in [0, 2 pi).
std::optional<Interval> while_outside(const AxisFrame& axis, const Vec3& point, const Vec3& centre,
                                      double radius) {
  const Vec3 p = axis.to_axis(point), c = axis.to_axis(centre);
  const double constant = p.squaredNorm() + c.squaredNorm() - 2 * p.z() * c.z() - radius * radius,
               swing = 2 * core::hypotenuse(p.x(), p.y()) * core::hypotenuse(c.x(), c.y());
  if (constant - swing > 0) return Interval{0, 2 * two_pi};
  if (constant + swing <= 0) return std::nullopt;
  const double nearest = core::arctangent(c.y(), c.x()) - core::arctangent(p.y(), p.x()),
               a = core::arccosine(constant / swing);
  const double turns = std::floor((nearest + a) / two_pi) * two_pi;
  return Interval{nearest + a - turns, nearest + two_pi - a - turns};
}

}  // namespace

RotatingBone::RotatingBone(const Joint& joint, BodyRole cut, const motion::Motion& motion)
    : axis(Vec3::Zero(), Vec3::UnitZ()), at_start(pose_at(joint.coordinates(), motion.start)) {
  const Vec3 in_fixed = axis_of(motion.vary, joint.coordinates(), motion.start);
  sense = sign_of(motion.sense);
  if (cut == BodyRole::mobile) {
    axis = AxisFrame(Vec3::Zero(), in_fixed);
    return;
  }
  // X_FM = Rot(u, t) X gives X_MF = Rot(X^-1 u, -t) X^-1.
  at_start = inverted(at_start);
  axis = AxisFrame(Vec3::Zero(), at_start.linear() * in_fixed);
  sense = -sense;
}

Sweep::Sweep(const Joint& joint, BodyRole cut, const Mesh& other, const motion::Motion& motion,
             const std::optional<BearingBall>& ball)
    : cut_(cut), rotating_(joint, cut, motion), rings_(other, rotating_.axis), ball_(ball) {}

Sweep Sweep::including_all() const {
  Sweep all = *this;
  all.ball_.reset();
  return all;
}

std::vector<double> Sweep::first_inside(PointsView points, Angle reach) const {
  const Points started = posed(rotating_.at_start, points);
  const tangential::OccupiedArcs arcs = rings_.occupied_arcs(started);
  std::vector<double> first(points.size(), never);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (arcs.of(i).empty() || (ball_ && cut_ == BodyRole::mobile && ball_->holds(points[i]))) continue;
    first[i] = first_of(started[i], arcs.of(i), reach.radians());
  }
  return first;
}

double Sweep::first_of(const Vec3& started, std::span<const tangential::OccupiedArc> arcs,
                       double reach) const {
  // Points of the fixed body count if the mobile bone that they are in is outside the ball.
  std::optional<Interval> counts = Interval{0, 2 * two_pi};
  if (ball_ && cut_ == BodyRole::fixed)
    counts = while_outside(rotating_.axis, started, ball_->centre, ball_->radius_mm);
  if (!counts) return never;
  double first = never;
  for (const tangential::OccupiedArc& arc : arcs) {
    Interval inside{arc.begin.radians(), arc.end.radians()};
    Interval included = *counts;
    if (rotating_.sense < 0) {
      inside = {two_pi - inside.end, two_pi - inside.begin};
      included = {two_pi - included.end, two_pi - included.begin};
    }
    for (const double turn : {-two_pi, 0.0, two_pi})
      for (const double included_turn : {-two_pi, 0.0, two_pi}) {
        const double begin = std::max({0.0, inside.begin + turn, included.begin + included_turn}),
                     end = std::min({reach, inside.end + turn, included.end + included_turn});
        if (begin <= end) first = std::min(first, begin);
      }
  }
  return first;
}

}  // namespace condyle::plan
