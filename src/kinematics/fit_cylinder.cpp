#include "condyle/fit.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>

#include "condyle/error.hpp"
#include "core/predicates.hpp"
#include "core/trigonometry.hpp"

namespace condyle {
namespace {

using Vec4 = Eigen::Vector4d;
using Mat4 = Eigen::Matrix4d;

/// As for spheres: see fit_sphere.cpp.
constexpr double local = 1e-6;
constexpr double cylinder_settled = 1e-13;
constexpr int most_steps = 100;

/// Smallest over largest pivot of the normal equations (lengths in units of the patch) below which some
/// motion of the axis changes no distance to it: the points lie in one plane, on one line or on two parallel
/// ones.
constexpr double undetermined = 1e-12;

struct Axis {
  Vec3 point, direction;
};

/// Two unit vectors across a direction.
std::pair<Vec3, Vec3> across(const Vec3& direction) noexcept {
  Eigen::Index smallest = 0;
  direction.cwiseAbs().minCoeff(&smallest);
  const Vec3 e1 = direction.cross(Vec3::Unit(smallest)).normalized();
  return {e1, direction.cross(e1)};
}

double mean_distance(PointsView points, std::span<const Index> vertices, const Axis& axis) {
  double sum = 0;
  for (const Index v : vertices) sum += (points[v] - axis.point).cross(axis.direction).norm();
  return sum / static_cast<double>(vertices.size());
}

double sum_of_squares(PointsView points, std::span<const Index> vertices, const Axis& axis) {
  const double radius = mean_distance(points, vertices, axis);
  double squares = 0;
  for (const Index v : vertices) {
    const double residual = (points[v] - axis.point).cross(axis.direction).norm() - radius;
    squares += residual * residual;
  }
  return squares;
}

/// One Gauss-Newton step: two shifts of the axis along e1 and e2, two tilts of its direction towards them.
/// With q the point seen from the axis' point, t = q.a its height and u its unit ray across the axis,
///
///     d distance / d shift = -u.e          d distance / d tilt = -t u.e
///
/// and the radius is the mean distance, so every row is taken less the mean row. Tilts are in units of
/// 1 / extent, so that all four unknowns are lengths.
Vec4 axis_step(PointsView points, std::span<const Index> vertices, const Axis& axis, double extent) {
  const auto [e1, e2] = across(axis.direction);
  const auto row_of = [&, e1 = e1, e2 = e2](Index v, double& distance) -> Vec4 {
    const Vec3 q = points[v] - axis.point;
    const double height = q.dot(axis.direction);
    const Vec3 ray = q - height * axis.direction;
    distance = ray.norm();
    if (!(distance > 0)) return Vec4::Zero();
    const double c = -ray.dot(e1) / distance, s = -ray.dot(e2) / distance, t = height / extent;
    return {c, s, t * c, t * s};
  };
  Vec4 mean_row = Vec4::Zero();
  double radius = 0, distance = 0;
  for (const Index v : vertices) {
    mean_row += row_of(v, distance);
    radius += distance;
  }
  const auto count = static_cast<double>(vertices.size());
  mean_row /= count;
  radius /= count;
  Mat4 A = Mat4::Zero();
  Vec4 b = Vec4::Zero();
  for (const Index v : vertices) {
    const Vec4 row = row_of(v, distance) - mean_row;
    A += row * row.transpose();
    b -= (distance - radius) * row;
  }
  const Eigen::LDLT<Mat4> factors(A);
  const Vec4 pivots = factors.vectorD();
  if (!(pivots.minCoeff() > undetermined * pivots.maxCoeff()))
    throw MeshError("the vertices do not fix the axis of a cylinder");
  return factors.solve(b);
}

Axis moved(const Axis& axis, const Vec4& step, double extent) {
  const auto [e1, e2] = across(axis.direction);
  return {axis.point + step[0] * e1 + step[1] * e2,
          (axis.direction + step[2] / extent * e1 + step[3] / extent * e2).normalized()};
}

Vec3 largest_component_positive(const Vec3& direction) noexcept {
  Eigen::Index largest = 0;
  direction.cwiseAbs().maxCoeff(&largest);
  return direction[largest] < 0 ? Vec3(-direction) : direction;
}

/// The share of a turn in which there are vertices: of so many sectors. Coarser than the edges of any bone fitted.
double share_of_turn(PointsView points, std::span<const Index> vertices, const Axis& axis) {
  constexpr std::size_t sectors = 36;
  std::array<bool, sectors> taken{};
  const auto [e1, e2] = across(axis.direction);
  for (const Index v : vertices) {
    const Vec3 q = points[v] - axis.point;
    const double turn = core::arctangent(q.dot(e2), q.dot(e1)) / two_pi + 0.5;
    taken[std::min(static_cast<std::size_t>(turn * sectors), sectors - 1)] = true;
  }
  return static_cast<double>(std::count(taken.begin(), taken.end(), true)) / sectors;
}

}  // namespace

CylinderFit fit_cylinder(PointsView points, std::span<const Index> vertices, const Cylinder& start) {
  if (vertices.size() < 5)
    throw MeshError("a cylinder needs at least 5 vertices, not " + std::to_string(vertices.size()));
  const auto count = static_cast<double>(vertices.size());
  Vec3 centroid = Vec3::Zero();
  for (const Index v : vertices) centroid += points[v] / count;
  double extent = 0;
  for (const Index v : vertices) extent = std::max(extent, (points[v] - centroid).norm());

  // The axis' point is kept beside the centroid: heights are then about 0 and shifts do not mix with tilts.
  const auto beside = [&](const Axis& a) -> Axis {
    return {a.point + (centroid - a.point).dot(a.direction) * a.direction, a.direction};
  };
  Axis axis = beside({start.point, start.direction.normalized()});
  const double noise = cylinder_settled * extent + 4 * core::rounding_unit * centroid.norm();
  for (int i = 0; i < most_steps; ++i) {
    Vec4 step = axis_step(points, vertices, axis, extent);
    if (step.norm() > local * extent) {
      const double squares = sum_of_squares(points, vertices, axis);
      while (step.norm() > local * extent &&
             !(sum_of_squares(points, vertices, moved(axis, step, extent)) < squares))
        step /= 2;
    }
    axis = beside(moved(axis, step, extent));
    if (!(step.norm() > noise)) break;
  }

  CylinderFit fit{
      {axis.point, largest_component_positive(axis.direction), mean_distance(points, vertices, axis)},
      std::sqrt(sum_of_squares(points, vertices, axis) / count),
      0,
      {vertices.begin(), vertices.end()},
      share_of_turn(points, vertices, axis)};
  for (const Index v : vertices) {
    const double distance = (points[v] - axis.point).cross(axis.direction).norm();
    fit.largest_residual = std::max(fit.largest_residual, std::abs(distance - fit.cylinder.radius));
  }
  return fit;
}

}  // namespace condyle
