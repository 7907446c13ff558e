#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>

#include "condyle/joint.hpp"
#include "core/trigonometry.hpp"
#include "kinematics/ligament_path.hpp"

/// Ligaments along a recorded motion, and how fast they become longer.

namespace condyle {
namespace {

/// The vector along the axis of a rotation and as long as its angle, at most pi.
Vec3 rotation_vector(const Eigen::Matrix3d& R) noexcept {
  // The quaternion with a part w of 0 or more has it: near a half turn the antisymmetric part of R has lost the axis.
  const Eigen::Quaterniond q(R);
  const Vec3 v = q.w() < 0 ? Vec3(-q.vec()) : Vec3(q.vec());
  const double sine = v.norm();
  if (!(sine > 0)) return Vec3::Zero();
  return 2 * core::arctangent(sine, std::abs(q.w())) / sine * v;
}

/// A frame beside another: how much later it is, and how far the body is moved and turned from there.
struct Beside {
  double after_s;
  Vec3 by, turn;
};

/// The slope at 0 of the parabola through 0 at 0, p and q.
Vec3 slope(double p_s, const Vec3& p, double q_s, const Vec3& q) noexcept {
  return (p * q_s / p_s - q * p_s / q_s) / (q_s - p_s);
}

}  // namespace

std::optional<double> lengthening_mm_s(const Ligament& ligament, const Pose& X_FM,
                                       const RelativeMotion& motion) noexcept {
  LigamentWrap in_fixed;
  const auto path = kinematics::crossing(ligament.fixed.back(), posed(X_FM, ligament.mobile.back()),
                                         kinematics::wrap_in_fixed(ligament, X_FM, in_fixed));
  if (!path) return std::nullopt;
  const Vec3 from_origin = path->on_mobile - X_FM.translation();
  return path->direction.dot(motion.velocity_mm_s + motion.angular_velocity_rad_s.cross(from_origin));
}

double damping_n(const Ligament& ligament, double strain, double strain_rate_per_s) noexcept {
  if (!(strain > 0) || !(strain_rate_per_s > 0)) return 0;
  constexpr double phased_in_by = 0.01;  // strain, as OpenSim has it
  const double x = std::min(1.0, strain / phased_in_by);
  return ligament.damping_n_s * strain_rate_per_s * (x * x * x * (10 + x * (6 * x - 15)));
}

bool has_damping(const std::vector<Ligament>& ligaments) noexcept {
  return std::any_of(ligaments.begin(), ligaments.end(),
                     [](const Ligament& ligament) { return ligament.damping_n_s > 0; });
}

std::vector<LigamentAlong> ligaments_along(const std::vector<Ligament>& ligaments,
                                           const std::vector<std::optional<Pose>>& X_FM,
                                           const std::vector<std::optional<RelativeMotion>>& motions) {
  assert((motions.empty() || motions.size() == X_FM.size()) && "one motion per pose, or none");
  std::vector<LigamentAlong> all;
  for (const Ligament& ligament : ligaments) {
    LigamentAlong& along = all.emplace_back(LigamentAlong{ligament.name, ligament.slack_length_mm});
    along.frames.reserve(X_FM.size());
    for (const std::optional<Pose>& X : X_FM)
      along.frames.push_back(X ? ligament_state(ligament, *X) : std::nullopt);
    if (motions.empty()) continue;
    along.damping.resize(X_FM.size());
    for (std::size_t i = 0; i < X_FM.size(); ++i) {
      if (!along.frames[i] || !motions[i]) continue;
      const double speed = *lengthening_mm_s(ligament, *X_FM[i], *motions[i]);
      const double damping = damping_n(ligament, along.frames[i]->strain, speed / ligament.slack_length_mm);
      along.damping[i] = {speed, damping, along.frames[i]->tension_n + damping};
    }
  }
  return all;
}

std::vector<std::optional<RelativeMotion>> motions_along(const std::vector<std::optional<Pose>>& X_FM,
                                                         const std::vector<double>& time_s) {
  assert(time_s.size() == X_FM.size() && "one time per pose");
  std::vector<std::optional<RelativeMotion>> motions(X_FM.size());
  for (std::size_t first = 0; first < X_FM.size();) {
    std::size_t end = first;
    while (end < X_FM.size() && X_FM[end]) ++end;
    for (std::size_t i = first; i < end && end - first > 1; ++i) {
      const auto beside = [&](std::size_t j) {
        return Beside{time_s[j] - time_s[i], X_FM[j]->translation() - X_FM[i]->translation(),
                      rotation_vector(X_FM[j]->linear() * X_FM[i]->linear().transpose())};
      };
      if (end - first == 2) {
        const Beside other = beside(i == first ? first + 1 : first);
        motions[i] = {other.by / other.after_s, other.turn / other.after_s};
        continue;
      }
      const Beside p = beside(i == first ? i + 1 : i - 1), q = beside(i == first     ? i + 2
                                                                      : i + 1 == end ? i - 2
                                                                                     : i + 1);
      motions[i] = {slope(p.after_s, p.by, q.after_s, q.by), slope(p.after_s, p.turn, q.after_s, q.turn)};
    }
    first = end + 1;
  }
  return motions;
}

}  // namespace condyle
