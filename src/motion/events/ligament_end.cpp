#include "motion/events/ligament_end.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "core/rotation_about.hpp"
#include "core/trigonometry.hpp"
#include "kinematics/ligament_path.hpp"

namespace condyle::motion {
namespace {

/// Rounding of a length, relative to what it is made of.
constexpr double length_rounding = 1e-14;

/// Angles at which a turning point is farther than `reach` from a stationary one, both in the frame of the axis:
///
///     |p - R(t) q|^2 - reach^2 = A cos t + B sin t + C > 0,   hypot(A, B) = r,
///
/// an arc about atan2(B, A), made wider by what rounding may have taken from it. r - C and r + C are products of sums and differences with the
/// least and the largest distance: no digits cancel.
StrainedAngles farther_than(double reach, const Vec3& p, const Vec3& q) {
  const double of_p = core::hypotenuse(p.x(), p.y()), of_q = core::hypotenuse(q.x(), q.y());
  const double along = p.z() - q.z();
  const double least = core::hypotenuse(of_p - of_q, along), largest = core::hypotenuse(of_p + of_q, along);
  if (reach >= largest) return {};
  if (reach < least) return {core::ArcSet::full_turn(), {}, {}};
  const double r_less_c = (reach - least) * (reach + least), r_and_c = (largest - reach) * (largest + reach);
  const double sine = std::sqrt(r_less_c * r_and_c);  // r times that of half the arc
  const double middle = core::arctangent(p.x() * q.y() - p.y() * q.x(), -(p.x() * q.x() + p.y() * q.y()));
  const double half = core::arctangent(sine, (r_less_c - r_and_c) / 2);
  const double of_squares = length_rounding * largest * largest;
  const double error = length_rounding + std::min(of_squares / sine, std::sqrt(of_squares / (of_p * of_q)));
  const double width = std::min(2 * (half + error), two_pi);
  return {core::ArcSet({{Angle::radians(middle - half - error), Angle::radians(width)}}),
          {},
          Angle::radians(2 * error)};
}

/// The straight distance between the ends at which a ligament over a sphere about the axis has this length; infinite if it is never so long.
double distance_at(double length, double to_a, double to_b, double r) {
  const double t_a = std::sqrt((to_a - r) * (to_a + r)), t_b = std::sqrt((to_b - r) * (to_b + r));
  if (length <= t_a + t_b) return length;
  const double gamma = core::arctangent(t_a, r) + core::arctangent(t_b, r) + (length - t_a - t_b) / r;
  if (gamma >= std::numbers::pi) return std::numeric_limits<double>::infinity();
  // |a - b|^2 = (|a| - |b|)^2 + 4 |a| |b| sin^2(gamma / 2)
  return core::hypotenuse(to_a - to_b, 2 * std::sqrt(to_a * to_b) * core::sine(gamma / 2));
}

/// Halves intervals of the turn until each is known to be free or strained: over an angle w the length changes by `speed` w at most, the distance
/// from the axis of the end that moves past the wrap. What is not known at the end counts as strained.
class LigamentSearch {
 public:
  LigamentSearch(const Ligament& ligament, const AxisFrame& axis, const Pose& X_FM, double reach)
      : ligament_(ligament), axis_(axis), X_FM_(X_FM), reach_(reach) {
    const Vec3 fixed = axis.to_axis(ligament.fixed.back());
    const Vec3 mobile = axis.to_axis(posed(X_FM, ligament.mobile.back()));
    const Vec3& moves = ligament.wrap->body == BodyRole::fixed ? mobile : fixed;
    speed_ = core::hypotenuse(moves.x(), moves.y());
    rounding_ = length_rounding * (fixed.norm() + mobile.norm() + ligament.wrap->radius_mm + reach);
  }

  StrainedAngles angles() {
    constexpr int begins_with = 64;
    constexpr std::size_t most_at_once = 8192;
    constexpr double narrowest = 1e-13;
    double width = two_pi / begins_with;
    std::vector<double> open;
    for (int i = 0; i < begins_with; ++i) open.push_back(i * width);
    while (true) {
      std::vector<double> halves;
      for (const double from : open)
        if (!is_known(from, width)) halves.push_back(from), halves.push_back(from + width / 2);
      width /= 2;
      open = std::move(halves);
      if (open.empty() || width < narrowest || open.size() > most_at_once) break;
    }
    for (const double from : open) {
      add(beyond_, from, width);
      // As the end comes to the wrap, what ends the motion is that its length is not known.
      if (outside_at(from + width / 2) <= speed_ * width / 2 + rounding_) add(unknown_, from, width);
    }
    StrainedAngles found{core::ArcSet(beyond_), core::ArcSet(unknown_), {}};
    // The intervals that stayed open lie side by side at each end: all of them together are not narrower.
    found.error_bound = Angle::radians(static_cast<double>(open.size()) * width);
    return found;
  }

 private:
  /// Wider by some roundings of an angle: neighbours leave no gap.
  static void add(std::vector<core::Arc>& arcs, double from, double width) {
    arcs.push_back({Angle::radians(from), Angle::radians(width + 2e-15)});
  }

  struct Placed {
    Vec3 mobile;
    LigamentWrap wrap;
  };
  Placed placed_at(double angle) const {
    const Eigen::Matrix3d& to_axis = axis_.rotation();
    const Eigen::Matrix3d R = to_axis.transpose() * core::rotation_about(Vec3::UnitZ(), angle) * to_axis;
    Pose X = X_FM_;
    X.linear() = R * X_FM_.linear();
    X.translation() = axis_.point() + R * (X_FM_.translation() - axis_.point());
    Placed placed{posed(X, ligament_.mobile.back()), {}};
    kinematics::wrap_in_fixed(ligament_, X, placed.wrap);
    return placed;
  }

  /// How far outside of the wrap the end is that moves past it; the one on its own body is outside in all poses.
  double outside_of(const Placed& at) const {
    const Vec3& moves = at.wrap.body == BodyRole::fixed ? at.mobile : ligament_.fixed.back();
    return kinematics::distance_from_middle(at.wrap, moves) - at.wrap.radius_mm;
  }
  double outside_at(double angle) const { return outside_of(placed_at(angle)); }

  /// Whether all of an interval is free, strained or without a length; the last two are noted.
  bool is_known(double from, double width) {
    const Placed at = placed_at(from + width / 2);
    const double slack = speed_ * width / 2 + rounding_, outside = outside_of(at);
    if (outside < -slack) {
      add(beyond_, from, width);
      add(unknown_, from, width);
      return true;
    }
    if (!(outside > slack)) return false;
    const auto path = kinematics::crossing(ligament_.fixed.back(), at.mobile, &at.wrap);
    if (!path) return false;
    const double over = path->length_mm - reach_;
    if (over > slack) add(beyond_, from, width);
    return std::abs(over) > slack;
  }

  const Ligament& ligament_;
  const AxisFrame& axis_;
  const Pose& X_FM_;
  double reach_, speed_ = 0, rounding_ = 0;
  std::vector<core::Arc> beyond_, unknown_;
};

}  // namespace

StrainedAngles strained_angles(const Ligament& ligament, const AxisFrame& axis, const Pose& X_FM) {
  const double reach =
      ligament.slack_length_mm * (1 + *ligament.ends_at_strain) - kinematics::constant_length_mm(ligament);
  if (!(reach > 0)) return {core::ArcSet::full_turn(), {}, {}};
  const Vec3 fixed = axis.to_axis(ligament.fixed.back());
  const Vec3 mobile = axis.to_axis(posed(X_FM, ligament.mobile.back()));
  if (!ligament.wrap) return farther_than(reach, fixed, mobile);
  LigamentWrap storage;
  const LigamentWrap& wrap = *kinematics::wrap_in_fixed(ligament, X_FM, storage);
  const Vec3 centre = axis.to_axis(wrap.centre);
  if (wrap.shape == WrapShape::sphere && centre.x() == 0 && centre.y() == 0) {
    const double to_a = (fixed - centre).norm(), to_b = (mobile - centre).norm();
    if (to_a >= wrap.radius_mm && to_b >= wrap.radius_mm)
      return farther_than(distance_at(reach, to_a, to_b, wrap.radius_mm), fixed, mobile);
  }
  return LigamentSearch(ligament, axis, X_FM, reach).angles();
}

}  // namespace condyle::motion
