#include "spherical_shell.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <limits>

#include "mesh/surface_distance.hpp"

namespace bench {
namespace {

using condyle::Vec3;

/// Where a patch is flat its sphere has no centre: it is put this many times the patch's radius away. The
/// shell of a flat disc is then half a hundredth of its radius thick, and what rounding takes is 1e-12 of it.
constexpr double farthest_centre = 100;

/// Centre of the sphere that fits the points best, or of a wide one where they are flat.
///
/// About their mean, |p|^2 = 2 c.p + k in the least-squares sense: 2 A c = sum |p|^2 p with A = sum p p^T,
/// solved along the axes of A. Across a flat patch A vanishes and any c is as good: the farthest is taken.
Vec3 centre_of_curvature(std::span<const Vec3> corners, double radius) {
  Vec3 mean = Vec3::Zero();
  for (const Vec3& p : corners) mean += p / static_cast<double>(corners.size());
  Eigen::Matrix3d A = Eigen::Matrix3d::Zero();
  Vec3 b = Vec3::Zero();
  for (const Vec3& corner : corners) {
    const Vec3 p = corner - mean;
    A += p * p.transpose();
    b += p.squaredNorm() * p;
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(A);
  const double limit = farthest_centre * radius;
  Vec3 centre = mean;
  for (int i = 0; i < 3; ++i) {
    const Vec3 axis = axes.eigenvectors().col(i);
    const double spread = 2 * axes.eigenvalues()[i], pull = b.dot(axis);
    const bool is_flat = std::abs(pull) >= limit * spread;
    centre += axis * (is_flat ? std::copysign(limit, pull) : pull / spread);
  }
  return centre;
}

/// The cone about the mean direction in which the points are seen.
Cap cap_around(std::span<const Vec3> corners, const Vec3& centre) {
  Vec3 sum = Vec3::Zero();
  for (const Vec3& p : corners) sum += (p - centre).normalized();
  const Vec3 axis = sum.normalized();
  double cos = 1;
  for (const Vec3& p : corners) cos = std::min(cos, (p - centre).normalized().dot(axis));
  cos -= relative_rounding;
  if (!(cos > 0)) return {};
  return {axis, cos, std::sqrt((1 - cos) * (1 + cos))};
}

}  // namespace

SphericalShell SphericalShell::around(std::span<const Vec3> corners) {
  SphericalShell shell;
  shell.ball = Ball::around(corners);
  shell.centre = centre_of_curvature(corners, shell.ball.radius);
  shell.cap = cap_around(corners, shell.centre);
  shell.inner = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < corners.size(); i += 3) {
    const condyle::mesh::TriangleCorners t{corners[i], corners[i + 1], corners[i + 2]};
    shell.inner = std::min(shell.inner, condyle::mesh::distance_to_triangle(shell.centre, t));
    for (const Vec3& p : t) shell.outer = std::max(shell.outer, (p - shell.centre).norm());
  }
  shell.widen(shell.centre);
  return shell;
}

SphericalShell SphericalShell::posed(const condyle::Pose& X) const {
  SphericalShell moved{condyle::posed(X, centre), inner, outer, cap, ball.posed(X)};
  moved.cap.axis = X.linear() * cap.axis;
  moved.widen(centre);
  return moved;
}

/// By the rounding of the centre, which was `before`, and of what the shell holds.
void SphericalShell::widen(const Vec3& before) {
  const double rounding = relative_rounding * (before.norm() + centre.norm() + outer);
  inner = std::max(0.0, inner - rounding);
  outer += rounding;
}

/// Whether the other is wholly nearer to the centre than this shell, or wholly farther from it. With d from
/// this centre to the other's, its points are d + r u: |d + r u|^2 = |d|^2 + 2 r d.u + r^2.
bool SphericalShell::is_beside(const SphericalShell& other) const {
  const Vec3 d = other.centre - centre;
  const double most = other.cap.reach(d), least = -other.cap.reach(-d);
  const auto squared = [&](double r, double along) { return d.squaredNorm() + 2 * r * along + r * r; };
  const double nearest = squared(std::clamp(-least, other.inner, other.outer), least);
  const double farthest = std::max(squared(other.inner, most), squared(other.outer, most));
  const double rounding = relative_rounding * (2 * d.squaredNorm() + 2 * other.outer * other.outer);
  return nearest - rounding > outer * outer || farthest + rounding < inner * inner;
}

/// Whether no direction of this cone meets the ball: the ball's centre is farther from the axis than the
/// cone's angle and the one under which the ball is seen together.
bool SphericalShell::looks_past(const Ball& other) const {
  if (cap.is_all()) return false;
  const Vec3 to = other.centre - centre;
  const double distance = to.norm();
  if (distance <= other.radius) return false;
  const double sin = other.radius / distance, cos = std::sqrt((1 - sin) * (1 + sin));
  return to.dot(cap.axis) < (cap.cos * cos - cap.sin * sin - 4 * relative_rounding) * distance;
}

}  // namespace bench
