#include "kinematics/head_shape.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <vector>

#include "core/formatted.hpp"
#include "core/rounded.hpp"
#include "core/symmetric.hpp"
#include "kinematics/hip_anatomy.hpp"
#include "kinematics/surface_points.hpp"

namespace condyle::kinematics {
namespace {

/// A head that is stretched by a fifth leaves its sphere by this share of the radius.
constexpr double widest_band = 0.1;
/// Cosine between a triangle's normal and the ray through it: a neck's is less, the inner wall of a cartilage's below 0.
constexpr double least_facing = 0.8;
constexpr std::size_t fewest_head_points = 60,
                      most_head_points = 2000;  // for nine numbers; coarse heads are polyhedra
/// Cosine of the angle from the neck's axis within which a cam may be: 60 degrees.
constexpr double beside_neck = 0.5;
/// Between the longest axis and the shortest.
constexpr double largest_ratio = 1.095;

using Quadric = Eigen::Matrix<double, 9, 1>;
using Normal = Eigen::Matrix<double, 9, 9>;

/// Coefficients' factors in x^T A x + b^T x = 1.
Quadric terms_of(const Vec3& p) {
  Quadric terms;
  terms << p.cwiseProduct(p), 2 * p.x() * p.y(), 2 * p.x() * p.z(), 2 * p.y() * p.z(), p;
  return terms;
}

/// Vertices of triangles of the head away from its neck, from its centre in its radii.
std::vector<Vec3> head_points(const TriMesh& mesh, const Sphere& head) {
  std::vector<std::uint8_t> is_on(mesh.vertices.size());
  const Vec3 neck = towards_neck(mesh, head).value_or(Vec3::Zero());
  const auto is_near = [&](const Vec3& ray) { return std::abs(ray.norm() / head.radius - 1) <= widest_band; };
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Vec3 a = mesh.corner(t, 0) - head.centre, b = mesh.corner(t, 1) - head.centre,
               c = mesh.corner(t, 2) - head.centre;
    if (!is_near(a) || !is_near(b) || !is_near(c)) continue;
    const Vec3 area = (b - a).cross(c - a), ray = a + b + c;
    if (area.dot(ray) < least_facing * area.norm() * ray.norm() || neck.dot(ray) > beside_neck * ray.norm())
      continue;
    for (const Index v : mesh.triangles[t]) is_on[v] = 1;
  }
  const auto on = static_cast<std::size_t>(std::count(is_on.begin(), is_on.end(), 1)),
             stride = on / most_head_points + 1;
  std::vector<Vec3> points;
  for (std::size_t v = 0, seen = 0; v < is_on.size(); ++v)
    if (is_on[v] && seen++ % stride == 0) points.push_back((mesh.vertices[v] - head.centre) / head.radius);
  return points;
}

Quadric quadric_through(const std::vector<Vec3>& points) {
  Normal squares = Normal::Zero();
  Quadric sum = Quadric::Zero();
  for (const Vec3& point : points) {
    const Quadric terms = terms_of(point);
    squares.selfadjointView<Eigen::Lower>().rankUpdate(terms);
    sum += terms;
  }
  return squares.ldlt().solve(sum);  // reads the lower half
}

/// The quadric through most of the points: those off it by more than three robust deviations are left out, and it is fitted again.
Quadric trimmed_quadric(std::vector<Vec3> points) {
  constexpr int rounds = 12;
  constexpr double deviations_kept = 3;
  Quadric quadric = quadric_through(points);
  for (int round = 1; round < rounds; ++round) {
    std::vector<double> residuals;
    for (const Vec3& point : points) residuals.push_back(terms_of(point).dot(quadric) - 1);
    const double most = deviations_kept * robust_deviation(residuals);
    std::size_t kept = 0;
    for (std::size_t i = 0; i < points.size(); ++i)
      if (std::abs(residuals[i]) <= most) points[kept++] = points[i];
    if (kept == points.size() || kept < fewest_head_points) break;
    points.resize(kept);
    quadric = quadric_through(points);
  }
  return quadric;
}

}  // namespace

std::optional<HeadShape> head_shape(const TriMesh& mesh, const Sphere& head) {
  std::vector<Vec3> points = head_points(mesh, head);
  if (points.size() < fewest_head_points) return std::nullopt;
  const Quadric q = trimmed_quadric(std::move(points));
  Eigen::Matrix3d A;
  A << q[0], q[3], q[4], q[3], q[1], q[5], q[4], q[5], q[2];
  const auto [values, directions] = core::axes_of(A);
  if (!(values[0] > 0)) return std::nullopt;
  // Largest eigenvalue last: the shortest axis.
  const Vec3 lengths = (values[2] / values.array()).sqrt();
  return HeadShape{lengths.reverse(), directions.rowwise().reverse()};
}

std::optional<JointNote> head_shape_note(const Joint& joint, const Sphere& head) {
  if (!joint.person.is_human()) return std::nullopt;
  const auto shape = head_shape(joint.mobile.mesh, head);
  if (!shape || shape->axes[2] <= largest_ratio) return std::nullopt;
  // Along the axis that is most of the joint's, with its sense.
  Vec3 longest = shape->directions.col(2);
  Eigen::Index most = 0;
  longest.cwiseAbs().maxCoeff(&most);
  if (longest[most] < 0) longest = -longest;
  return JointNote{JointNoteCode::head_not_round,
                   "the head of " + joint.mobile.name +
                       core::formatted(" is %.0f %% longer along ", 100 * (shape->axes[2] - 1)) +
                       core::rounded(longest, 2) +
                       " than across: is the spacing of slices wrong, or was the scan tilted? Limits may be "
                       "off by tens of "
                       "degrees; a head of this shape, as after Perthes' disease, turns about no one centre"};
}

}  // namespace condyle::kinematics
