#include "condyle/fit.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "condyle/error.hpp"
#include "core/ordered_sums.hpp"
#include "core/predicates.hpp"
#include "core/symmetric.hpp"

namespace condyle {
namespace {

using Mat3 = Eigen::Matrix3d;

/// Ratio of the smallest to the largest variance of the points below which they are a plane: for a cap of a
/// sphere it is about (height / width)^2 / 5, and a cap this flat (1e-4 of its width high) gives its radius
/// to no digit once its coordinates were rounded to float.
constexpr double flat = 1e-9;

/// Gauss-Newton converges here in some ten steps, lengths in units of the patch. A step that does not lower
/// the sum of squares is halved; one shorter than `local_step` is taken as it is, for it changes the sum by its
/// square, which rounding hides. A step shorter than `sphere_settled` is no news.
constexpr double local_step = 1e-6;
constexpr double sphere_settled = 1e-13;
constexpr int most_sphere_steps = 100;

Vec3 mean_of(PointsView points, std::span<const Index> vertices) {
  Vec3 sum = Vec3::Zero();
  for (const Index v : vertices) sum += points[v];
  return sum / static_cast<double>(vertices.size());
}

/// The sum of products w w^T: six sums.
struct SumOfProducts {
  double xx = 0, yy = 0, zz = 0, yx = 0, zx = 0, zy = 0;

  void add(double x, double y, double z) noexcept {
    xx += x * x, yy += y * y, zz += z * z, yx += y * x, zx += z * x, zy += z * y;
  }
  Mat3 matrix() const {
    Mat3 sum;
    sum << xx, yx, zx, yx, yy, zy, zx, zy, zz;
    return sum;
  }
};

Mat3 covariance(PointsView points, std::span<const Index> vertices, const Vec3& mean) {
  SumOfProducts C;
  for (const Index v : vertices) {
    const Vec3 w = points[v] - mean;
    C.add(w.x(), w.y(), w.z());
  }
  return C.matrix() / static_cast<double>(vertices.size());
}

/// The sphere of least squares of |p|^2 - 2 c.p - k, about the mean: linear, exact for points on a sphere,
/// drawn to smaller spheres by noise. A start.
Vec3 algebraic_centre(PointsView points, std::span<const Index> vertices, const Vec3& mean, const Mat3& C) {
  Vec3 b = Vec3::Zero();
  for (const Index v : vertices) {
    const Vec3 p = points[v] - mean;
    b += core::ordered_dot(p, p) * p;
  }
  return mean + core::solved(C, b) / (2 * static_cast<double>(vertices.size()));
}

struct Step {
  Vec3 move;
  double squares;  ///< sum of squares of the residuals before it
};

/// Rays from a centre to the vertices, computed once for all sums over them: a fit has many steps. Sums are taken in few
/// passes: a sum alone waits for each of its additions.
class Rays {
 public:
  Rays(PointsView points, std::span<const Index> vertices)
      : x_(size_of(vertices)), y_(x_.size()), z_(x_.size()), ux_(x_.size()), uy_(x_.size()), uz_(x_.size()) {
    for (Eigen::Index i = 0; i < x_.size(); ++i) {
      const Vec3 p = points[vertices[static_cast<std::size_t>(i)]];
      x_[i] = p.x(), y_[i] = p.y(), z_[i] = p.z();
    }
  }

  void start_at(const Vec3& centre) {
    ux_ = x_ - centre.x(), uy_ = y_ - centre.y(), uz_ = z_ - centre.z();
    length_ = (ux_ * ux_ + uy_ * uy_ + uz_ * uz_).sqrt();
    ux_ /= length_, uy_ /= length_, uz_ /= length_;
    double lengths = 0;
    Vec3 units = Vec3::Zero();
    for (Eigen::Index i = 0; i < length_.size(); ++i) {
      lengths += length_[i];
      if (length_[i] > 0) units += unit(i);
    }
    mean_length_ = lengths / static_cast<double>(length_.size());
    mean_unit_ = units / static_cast<double>(length_.size());
  }

  double mean_length() const noexcept { return mean_length_; }

  /// One Gauss-Newton step of the centre. The best radius for a centre is the mean length, so only the centre is unknown:
  /// the residuals d_i - mean(d) change by -(u_i - mean(u)) per unit of centre, u_i the unit rays.
  Step centre_step() const {
    const Vec3 mean = mean_unit_;
    SumOfProducts A;
    double bx = 0, by = 0, bz = 0, squares = 0;
    for (Eigen::Index i = 0; i < length_.size(); ++i) {
      const double off = length_[i] - mean_length_;
      squares += off * off;
      if (!(length_[i] > 0)) continue;
      const double x = ux_[i] - mean.x(), y = uy_[i] - mean.y(), z = uz_[i] - mean.z();
      A.add(x, y, z);
      bx += off * x, by += off * y, bz += off * z;
    }
    return {core::solved(A.matrix(), Vec3(bx, by, bz)), squares};
  }

  double sum_of_squares() const noexcept {
    double squares = 0;
    for (Eigen::Index i = 0; i < length_.size(); ++i) {
      const double residual = length_[i] - mean_length_;
      squares += residual * residual;
    }
    return squares;
  }

  double largest_residual() const noexcept {
    double largest = 0;
    for (Eigen::Index i = 0; i < length_.size(); ++i)
      largest = std::max(largest, std::abs(length_[i] - mean_length_));
    return largest;
  }

 private:
  static Eigen::Index size_of(std::span<const Index> vertices) noexcept {
    return static_cast<Eigen::Index>(vertices.size());
  }
  /// The direction of a ray that has a length.
  Vec3 unit(Eigen::Index i) const noexcept { return {ux_[i], uy_[i], uz_[i]}; }

  Eigen::ArrayXd x_, y_, z_, ux_, uy_, uz_, length_;
  double mean_length_ = 0;
  Vec3 mean_unit_ = Vec3::Zero();
};

SphereFit with_residuals(const Rays& rays, std::span<const Index> vertices, const Vec3& centre) {
  return {{centre, rays.mean_length()},
          std::sqrt(rays.sum_of_squares() / static_cast<double>(vertices.size())),
          rays.largest_residual(),
          {vertices.begin(), vertices.end()}};
}

}  // namespace

SphereFit fit_sphere(PointsView points, std::span<const Index> vertices) {
  if (vertices.size() < 4)
    throw MeshError("a sphere needs at least 4 vertices, not " + std::to_string(vertices.size()));
  const Vec3 mean = mean_of(points, vertices);
  const Mat3 C = covariance(points, vertices, mean);
  const Vec3 variances = core::axes_of(C).values;
  if (!(variances[0] > flat * variances[2]))
    throw MeshError("the vertices lie in one plane: no sphere fits them");

  Vec3 centre = algebraic_centre(points, vertices, mean, C);
  const double patch = std::sqrt(variances[2]);
  const double noise = sphere_settled * patch + 4 * core::rounding_unit * core::ordered_norm(mean);
  Rays rays(points, vertices);
  rays.start_at(centre);
  for (int step = 0; step < most_sphere_steps; ++step) {
    auto [move, squares] = rays.centre_step();
    rays.start_at(centre + move);
    while (core::ordered_norm(move) > local_step * patch && !(rays.sum_of_squares() < squares)) {
      move /= 2;
      rays.start_at(centre + move);
    }
    centre += move;
    if (!(core::ordered_norm(move) > noise)) break;
  }
  if (!centre.allFinite()) throw MeshError("the vertices are not on a sphere: the fit does not settle");
  return with_residuals(rays, vertices, centre);
}

SphereFit fit_sphere(PointsView points) {
  std::vector<Index> all(points.size());
  std::iota(all.begin(), all.end(), Index{0});
  return fit_sphere(points, all);
}

}  // namespace condyle
