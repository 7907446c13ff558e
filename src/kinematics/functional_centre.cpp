#include "kinematics/functional_centre.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "condyle/error.hpp"
#include "core/formatted.hpp"
#include "core/symmetric.hpp"
#include "core/trigonometry.hpp"
#include "kinematics/resampling.hpp"

namespace condyle::kinematics {
namespace {

constexpr std::size_t resamples = 200;
/// Frames that follow each other share their error: stretches are drawn, so many of a recording.
constexpr std::size_t stretches = 20;
/// Rotations that leave an axis by more than this share of the turning about it have no axis.
constexpr double most_off_axis = 0.5;
/// What rounding leaves of a centre far from both origins goes with a second solution, of the residuals of the first.
constexpr int solutions = 2;

/// Sums over poses, of which centres and axes follow.
struct Sums {
  double count = 0;
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Zero();
  Vec3 translation = Vec3::Zero(), turned_back = Vec3::Zero();  ///< of t, and of R' t

  void add(const Pose& X) {
    ++count;
    rotation += X.linear();
    translation += X.translation();
    turned_back += X.linear().transpose() * X.translation();
  }
  Sums& operator+=(const Sums& other) {
    count += other.count;
    rotation += other.rotation;
    translation += other.translation;
    turned_back += other.turned_back;
    return *this;
  }

  Eigen::Matrix3d mean_rotation() const { return rotation / count; }
  /// I - R'R of the mean R: how far rotations spread.
  Eigen::Matrix3d spread() const {
    return Eigen::Matrix3d::Identity() - mean_rotation().transpose() * mean_rotation();
  }
  /// Of spread() c = this the point c of the mobile body is the solution.
  Vec3 right_side() const {
    return mean_rotation().transpose() * (translation / count) - turned_back / count;
  }
  Vec3 in_fixed(const Vec3& in_mobile) const { return mean_rotation() * in_mobile + translation / count; }
};

/// A direction's spread is the variance of where rotations take it: of angles, as far as they are small, about both directions across it.
Angle root_mean_square(double variance) {
  return Angle::radians(std::sqrt(std::max(0.0, variance)));
}

Turning turning_of(const core::SymmetricAxes& spread) {
  return {root_mean_square(spread.values[1]), root_mean_square(spread.values[0])};
}

Sums sums_of(std::span<const Pose> X_FM) {
  if (X_FM.size() < fewest_poses)
    throw MeshError("poses: there are " + std::to_string(X_FM.size()) + ", and " +
                    std::to_string(fewest_poses) + " are needed");
  Sums sums;
  for (const Pose& X : X_FM) sums.add(X);
  return sums;
}

/// The poses seen from these points of both bodies.
std::vector<Pose> seen_from(std::span<const Pose> X_FM, const Vec3& in_fixed, const Vec3& in_mobile) {
  std::vector<Pose> seen(X_FM.begin(), X_FM.end());
  for (Pose& X : seen) X.translation() = Vec3(X.linear() * in_mobile + X.translation() - in_fixed);
  return seen;
}

struct PointOfBoth {
  Vec3 in_fixed = Vec3::Zero(), in_mobile = Vec3::Zero();
  double residual_mm = 0;
};

/// `solve` gives the mobile body's point.
template <class Solve>
PointOfBoth found_by(const Solve& solve, std::span<const Pose> X_FM) {
  PointOfBoth found;
  for (int i = 0; i < solutions; ++i) {
    const Sums sums = sums_of(seen_from(X_FM, found.in_fixed, found.in_mobile));
    const Vec3 in_mobile = solve(sums);
    found.in_fixed += sums.in_fixed(in_mobile);
    found.in_mobile += in_mobile;
  }
  double squares = 0;
  for (const Pose& X : X_FM)
    squares += (X.linear() * found.in_mobile + X.translation() - found.in_fixed).squaredNorm();
  found.residual_mm = std::sqrt(squares / static_cast<double>(X_FM.size()));
  return found;
}

/// Sums of as many stretches as there are, each drawn at random; seen from the points found, so that nothing cancels.
std::vector<Sums> resampled(std::span<const Pose> X_FM, const PointOfBoth& found) {
  const std::vector<Pose> seen = seen_from(X_FM, found.in_fixed, found.in_mobile);
  std::vector<Sums> parts(stretches);
  for (std::size_t i = 0; i < seen.size(); ++i) parts[i * stretches / seen.size()].add(seen[i]);
  std::mt19937_64 random(resampling_seed);
  std::vector<Sums> drawn(resamples);
  for (Sums& sums : drawn)
    for (std::size_t k = 0; k < stretches; ++k) sums += parts[random() % stretches];
  return drawn;
}

/// What is drawn from few stretches spreads less than what they stand for: the root of their number over it less three unknowns.
const double widening = std::sqrt(double(stretches) / (stretches - 3));

std::string degrees(Angle angle) {
  return core::formatted("%.1f", angle.degrees());
}

Vec3 with_largest_positive(const Vec3& direction) {
  Eigen::Index largest;
  direction.cwiseAbs().maxCoeff(&largest);
  return direction[largest] < 0 ? Vec3(-direction) : direction;
}

/// Along the axis nothing is known: nothing is taken.
Vec3 across(const core::SymmetricAxes& axes, const Vec3& right_side) {
  Vec3 found = Vec3::Zero();
  for (int k = 1; k < 3; ++k)
    if (axes.values[k] > 0)
      found += axes.directions.col(k).dot(right_side) / axes.values[k] * axes.directions.col(k);
  return found;
}

}  // namespace

FunctionalCentre functional_centre(std::span<const Pose> X_FM) {
  const Turning turning = turning_of(core::axes_of(sums_of(X_FM).spread()));
  if (turning.off_axis < least_turning)
    throw MeshError("poses: they turn by " + degrees(turning.about_axis) + " degrees about one axis and by " +
                    degrees(turning.off_axis) + " off it (root mean square): a centre needs " +
                    degrees(least_turning) + " off it, as any point of that axis would do");
  const auto centre = [](const Sums& sums) { return core::solved(sums.spread(), sums.right_side()); };
  const PointOfBoth found = found_by(centre, X_FM);
  std::vector<double> changes;
  double squares = 0;
  for (const Sums& sums : resampled(X_FM, found)) {
    const double change = widening * sums.in_fixed(centre(sums)).norm();
    changes.push_back(change);
    squares += change * change;
  }
  return {found.in_fixed,
          found.in_mobile,
          found.residual_mm,
          upper_bound_of(std::move(changes)),
          std::sqrt(squares / static_cast<double>(3 * resamples)),
          turning,
          X_FM.size()};
}

FunctionalAxis functional_axis(std::span<const Pose> X_FM) {
  const Sums all = sums_of(X_FM);
  const core::SymmetricAxes axes = core::axes_of(all.spread());
  const Turning turning = turning_of(axes);
  if (turning.about_axis < least_turning)
    throw MeshError("poses: they turn by " + degrees(turning.about_axis) +
                    " degrees about its main axis (root mean square), and " + degrees(least_turning) +
                    " are needed");
  if (turning.off_axis.radians() > most_off_axis * turning.about_axis.radians())
    throw MeshError("poses: they turn by " + degrees(turning.about_axis) +
                    " degrees about its main axis and by " + degrees(turning.off_axis) +
                    " off it (root mean square): they have no one axis");
  const auto point = [](const Sums& sums) { return across(core::axes_of(sums.spread()), sums.right_side()); };
  const PointOfBoth found = found_by(point, X_FM);
  const Vec3 in_mobile = with_largest_positive(axes.directions.col(0));
  // The same direction in both bodies.
  const Vec3 in_fixed = (all.mean_rotation() * in_mobile).normalized();
  std::vector<double> turned, moved;
  for (const Sums& sums : resampled(X_FM, found)) {
    const core::SymmetricAxes drawn = core::axes_of(sums.spread());
    const Vec3 direction = (sums.mean_rotation() * drawn.directions.col(0)).normalized();
    turned.push_back(widening *
                     core::arctangent(direction.cross(in_fixed).norm(), std::abs(direction.dot(in_fixed))));
    const Vec3 at = sums.in_fixed(across(drawn, sums.right_side()));
    moved.push_back(widening * (at - at.dot(direction) * direction).norm());
  }
  return {{found.in_fixed, in_fixed},
          {found.in_mobile, in_mobile},
          found.residual_mm,
          Angle::radians(upper_bound_of(std::move(turned))),
          upper_bound_of(std::move(moved)),
          turning,
          X_FM.size()};
}

}  // namespace condyle::kinematics
