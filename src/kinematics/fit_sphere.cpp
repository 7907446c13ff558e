#include "condyle/fit.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "condyle/error.hpp"
#include "core/predicates.hpp"

namespace condyle {
namespace {

using Mat3 = Eigen::Matrix3d;

/// Ratio of the smallest to the largest variance of the points below which they are a plane: for a cap of a
/// sphere it is about (height / width)^2 / 5, and a cap this flat (1e-4 of its width high) gives its radius
/// to no digit once its coordinates were rounded to float.
constexpr double flat = 1e-9;

/// Gauss-Newton converges here in some ten steps, lengths in units of the patch. A step that does not lower
/// the sum of squares is halved; one shorter than `local` is taken as it is, for it changes the sum by its
/// square, which rounding hides. A step shorter than `settled` is no news.
constexpr double local = 1e-6;
constexpr double settled = 1e-13;
constexpr int most_steps = 100;

Vec3 mean_of(PointsView points, std::span<const Index> vertices) {
  Vec3 sum = Vec3::Zero();
  for (const Index v : vertices) sum += points[v];
  return sum / static_cast<double>(vertices.size());
}

Mat3 covariance(PointsView points, std::span<const Index> vertices, const Vec3& mean) {
  Mat3 C = Mat3::Zero();
  for (const Index v : vertices) C += (points[v] - mean) * (points[v] - mean).transpose();
  return C / static_cast<double>(vertices.size());
}

/// The sphere of least squares of |p|^2 - 2 c.p - k, about the mean: linear, exact for points on a sphere,
/// drawn to smaller spheres by noise. A start.
Vec3 algebraic_centre(PointsView points, std::span<const Index> vertices, const Vec3& mean, const Mat3& C) {
  Vec3 b = Vec3::Zero();
  for (const Index v : vertices) {
    const Vec3 p = points[v] - mean;
    b += p.squaredNorm() * p;
  }
  return mean + C.ldlt().solve(b) / (2 * static_cast<double>(vertices.size()));
}

struct Distances {
  double mean;
  Vec3 mean_direction;
};

Distances mean_distance(PointsView points, std::span<const Index> vertices, const Vec3& centre) {
  Distances d{0, Vec3::Zero()};
  for (const Index v : vertices) {
    const Vec3 w = points[v] - centre;
    const double length = w.norm();
    d.mean += length;
    if (length > 0) d.mean_direction += w / length;
  }
  const auto count = static_cast<double>(vertices.size());
  return {d.mean / count, d.mean_direction / count};
}

/// One Gauss-Newton step of the centre. The best radius for a centre is the mean distance, so only the centre
/// is unknown: the residuals d_i - mean(d) change by -(u_i - mean(u)) per unit of centre, u_i the unit rays.
Vec3 centre_step(PointsView points, std::span<const Index> vertices, const Vec3& centre) {
  const auto [radius, mean_ray] = mean_distance(points, vertices, centre);
  Mat3 A = Mat3::Zero();
  Vec3 b = Vec3::Zero();
  for (const Index v : vertices) {
    const Vec3 w = points[v] - centre;
    const double length = w.norm();
    if (!(length > 0)) continue;
    const Vec3 u = w / length - mean_ray;
    A += u * u.transpose();
    b += (length - radius) * u;
  }
  return A.ldlt().solve(b);
}

double sum_of_squares(PointsView points, std::span<const Index> vertices, const Vec3& centre) {
  const double radius = mean_distance(points, vertices, centre).mean;
  double squares = 0;
  for (const Index v : vertices) {
    const double residual = (points[v] - centre).norm() - radius;
    squares += residual * residual;
  }
  return squares;
}

SphereFit with_residuals(PointsView points, std::span<const Index> vertices, const Vec3& centre) {
  SphereFit fit{
      {centre, mean_distance(points, vertices, centre).mean}, 0, 0, {vertices.begin(), vertices.end()}};
  for (const Index v : vertices)
    fit.largest_residual =
        std::max(fit.largest_residual, std::abs((points[v] - centre).norm() - fit.sphere.radius));
  fit.rms_residual =
      std::sqrt(sum_of_squares(points, vertices, centre) / static_cast<double>(vertices.size()));
  return fit;
}

}  // namespace

SphereFit fit_sphere(PointsView points, std::span<const Index> vertices) {
  if (vertices.size() < 4)
    throw MeshError("a sphere needs at least 4 vertices, not " + std::to_string(vertices.size()));
  const Vec3 mean = mean_of(points, vertices);
  const Mat3 C = covariance(points, vertices, mean);
  const Vec3 variances = Eigen::SelfAdjointEigenSolver<Mat3>(C, Eigen::EigenvaluesOnly).eigenvalues();
  if (!(variances[0] > flat * variances[2]))
    throw MeshError("the vertices lie in one plane: no sphere fits them");

  Vec3 centre = algebraic_centre(points, vertices, mean, C);
  const double patch = std::sqrt(variances[2]);
  const double noise = settled * patch + 4 * core::rounding_unit * mean.norm();
  for (int step = 0; step < most_steps; ++step) {
    Vec3 move = centre_step(points, vertices, centre);
    if (move.norm() > local * patch) {
      const double squares = sum_of_squares(points, vertices, centre);
      while (move.norm() > local * patch && !(sum_of_squares(points, vertices, centre + move) < squares))
        move /= 2;
    }
    centre += move;
    if (!(move.norm() > noise)) break;
  }
  if (!centre.allFinite()) throw MeshError("the vertices are not on a sphere: the fit does not settle");
  return with_residuals(points, vertices, centre);
}

SphereFit fit_sphere(PointsView points) {
  std::vector<Index> all(points.size());
  std::iota(all.begin(), all.end(), Index{0});
  return fit_sphere(points, all);
}

}  // namespace condyle
