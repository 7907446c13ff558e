#include "motion/recorded/screw_motion.hpp"

#include <algorithm>
#include <cmath>

#include "core/predicates.hpp"
#include "core/rotation_about.hpp"
#include "core/trigonometry.hpp"

namespace condyle::motion {
namespace {

/// Rounding of the speeds below, relative, with much margin; they are bounds and are raised by it.
constexpr double speed_slack = 1e-12;

}  // namespace

double reach_of(const Mesh& mesh) {
  double reach = 0;
  for (std::size_t v = 0; v < mesh.vertices().size(); ++v) reach = std::max(reach, mesh.vertices()[v].norm());
  return reach;
}

/// The part of the origin's change D along the axis a is slide a; the rest, P, is the chord of a circle about the
/// line, whose centre seen from the chord's middle is at (a x P) / (2 tan(rotation / 2)). So the origin starts at
/// -(P + k a x P) / 2 from it, k = 1 / tan(rotation / 2), and after the angle t has moved by
///
///     sin t (k P - a x P) / 2 + (1 - cos t) (P + k a x P) / 2
///
/// which keeps its digits where the line is far away: the centre itself is not computed.
ScrewMotion::ScrewMotion(const Pose& from, const Pose& to, double reach_mm)
    : from_(from), axis_(Vec3::UnitZ()) {
  const Vec3 change = to.translation() - from.translation();
  const double rounding_mm =
      4 * core::rounding_unit * (reach_mm + from.translation().lpNorm<Eigen::Infinity>());
  holds_origin_ = change.lpNorm<Eigen::Infinity>() <= rounding_mm;

  // For a rotation R by t about a, the half of R - R^T is the cross product with a sin t, and the trace 1 + 2 cos t.
  const Eigen::Matrix3d R = to.linear() * from.linear().transpose();
  const Vec3 a_sine = 0.5 * Vec3(R(2, 1) - R(1, 2), R(0, 2) - R(2, 0), R(1, 0) - R(0, 1));
  const double sine = a_sine.norm(), angle = core::arctangent(sine, 0.5 * (R.trace() - 1));
  if (angle * reach_mm > rounding_mm) {
    rotation_ = angle;
    if (sine > 0) axis_ = a_sine / sine;
  }

  shift_ = holds_origin_ ? Vec3::Zero() : change;
  if (rotation_ > 0 && !holds_origin_) {
    shift_ = axis_.dot(change) * axis_;
    const Vec3 chord = change - shift_, across = axis_.cross(chord);
    const double k = 1 / core::tangent(rotation_ / 2);
    sine_ = 0.5 * (k * chord - across), cosine_ = 0.5 * (chord + k * across);
  }
  // At the start, and so everywhere on the way.
  const Vec3 velocity = shift_ + rotation_ * sine_;
  speed_ = {rotation_ * (1 + speed_slack), velocity.norm() * (1 + speed_slack)};
}

Pose ScrewMotion::at(double s) const {
  Pose X = from_;
  if (s == 0) return X;
  const double angle = s * rotation_;
  if (rotation_ > 0) X.linear() = core::rotation_about(axis_, angle) * from_.linear();
  const double half_sine = core::sine(angle / 2);
  X.translation() += s * shift_ + core::sine(angle) * sine_ + 2 * half_sine * half_sine * cosine_;
  return X;
}

}  // namespace condyle::motion
