#include <Eigen/Eigenvalues>

#include "ball.hpp"
#include "condyle/mesh/surface_distance.hpp"
#include "kinds.hpp"

namespace bench {
namespace {

/// Where a patch is flat its sphere has no centre: it is put this many times the patch's radius away. The
/// shell of a flat disc is then half a hundredth of its radius thick, and what rounding takes is 1e-12 of it.
constexpr double farthest_centre = 100;

/// Directions within an angle of an axis; less than a right angle, so that it is convex, or all directions.
struct Cap {
  Vec3 axis = Vec3::UnitX();
  double cos = -1, sin = 0;

  bool is_all() const { return cos < 0; }

  /// The most that d . u reaches over the unit vectors u of the cap.
  double reach(const Vec3& d) const {
    const double along = d.dot(axis), across = d.cross(axis).norm();
    if (is_all() || across * cos <= along * sin) return d.norm();
    return along * cos + across * sin;
  }
};

/// The part of the space between two concentric spheres that a cone from their centre cuts out:
///
///         . - ' ' - .
///        '. - ' ' - .'   outer
///          .       .     inner
///           .     .
///             . .        centre
///
struct Shell {
  Vec3 centre = Vec3::Zero();
  double inner = 0, outer = 0;
  Cap cap;
  Ball ball;  ///< Of the same triangles.

  static Shell around(std::span<const Vec3> corners);

  Shell posed(const Pose& X) const {
    Shell moved{condyle::posed(X, centre), inner, outer, cap, ball.posed(X)};
    moved.cap.axis = X.linear() * cap.axis;
    moved.widen(centre);
    return moved;
  }

  /// Whether nothing shows them apart: the balls, the distances of each from the other's centre, the cones
  /// about each other's balls.
  bool meets(const Shell& other) const {
    return ball.meets(other.ball) && !is_beside(other) && !other.is_beside(*this) &&
           !looks_past(other.ball) && !other.looks_past(ball);
  }

  double size() const { return ball.radius; }

 private:
  bool is_beside(const Shell& other) const;
  bool looks_past(const Ball& other) const;

  /// By the rounding of the centre, which was `before`, and of what the shell holds.
  void widen(const Vec3& before) {
    const double rounding = relative_rounding * (before.norm() + centre.norm() + outer);
    inner = std::max(0.0, inner - rounding);
    outer += rounding;
  }
};

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

Shell Shell::around(std::span<const Vec3> corners) {
  Shell shell;
  shell.ball = Ball::around(corners);
  shell.centre = centre_of_curvature(corners, shell.ball.radius);
  shell.inner = std::numeric_limits<double>::infinity();
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < corners.size(); i += 3) {
    const condyle::TriangleCorners t{corners[i], corners[i + 1], corners[i + 2]};
    shell.inner = std::min(shell.inner, condyle::distance_to_triangle(shell.centre, t));
    for (const Vec3& p : t) {
      shell.outer = std::max(shell.outer, (p - shell.centre).norm());
      sum += (p - shell.centre).normalized();
    }
  }
  const Vec3 axis = sum.normalized();
  double cos = 1;
  for (const Vec3& p : corners) cos = std::min(cos, (p - shell.centre).normalized().dot(axis));
  cos -= relative_rounding;
  if (cos > 0) shell.cap = {axis, cos, std::sqrt((1 - cos) * (1 + cos))};
  shell.widen(shell.centre);
  return shell;
}

/// Whether the other is wholly nearer to the centre than this shell, or wholly farther from it. With d from
/// this centre to the other's, its points are d + r u: |d + r u|^2 = |d|^2 + 2 r d.u + r^2.
bool Shell::is_beside(const Shell& other) const {
  const Vec3 d = other.centre - centre;
  const double most = other.cap.reach(d), least = -other.cap.reach(-d);
  const auto squared = [&](double r, double along) { return d.squaredNorm() + 2 * r * along + r * r; };
  const double nearest = squared(std::clamp(-least, other.inner, other.outer), least);
  const double farthest = std::max(squared(other.inner, most), squared(other.outer, most));
  const double rounding = relative_rounding * (2 * d.squaredNorm() + 2 * other.outer * other.outer);
  return nearest - rounding > outer * outer || farthest + rounding < inner * inner;
}

/// Whether no direction of this cone meets the ball.
bool Shell::looks_past(const Ball& other) const {
  if (cap.is_all()) return false;
  const Vec3 to = other.centre - centre;
  const double distance = to.norm();
  if (distance <= other.radius) return false;
  const double sin = other.radius / distance, cos = std::sqrt((1 - sin) * (1 + sin));
  return to.dot(cap.axis) < (cap.cos * cos - cap.sin * sin - 4 * relative_rounding) * distance;
}

}  // namespace

/// Spherical shells (Krishnan, Pattekar, Lin, Manocha 1998, "Spherical shell: a higher order bounding volume
/// for fast proximity queries"): they follow a curved patch, so that near contact they come apart sooner than
/// boxes, and each test costs more.
///
/// Taken from them: the volume, and a tree of it on each body. Theirs are fitted to smooth patches and
/// compared cone by cone; ours hold triangles, are fitted by least squares, and are compared by three tests
/// that are each enough to tell two of them apart, without deciding every case. Exact triangles at the
/// leaves.
std::vector<MethodKind> spherical_shell_kinds() {
  return {{"spherical_shells",
           "bounding volume hierarchies",
           "spherical shells (Krishnan 1998), plain",
           {.touch = true, .pairs = true, .deforms = true},
           DepthKind::none,
           true,
           [](const Bodies& bodies) { return std::make_unique<TwoTrees<Shell>>(bodies); }}};
}

}  // namespace bench
