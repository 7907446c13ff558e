#include "kinematics/socket_rim.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/symmetric.hpp"
#include "core/trigonometry.hpp"
#include "mesh/vertex_normals.hpp"

namespace condyle::kinematics {
namespace {

/// Wider than any joint space between bones, mm, of a head of the usual size: surface further off is not the socket's.
constexpr double widest_rim_space = 10;
/// How far a socket may reach into the head where the two overlap, mm.
constexpr double deepest_rim_overlap = 2;

/// The rim is measured in so many sectors around the socket's opening, and must be found in most of them.
constexpr std::size_t rim_sectors = 36, fewest_rim_sectors = 24;

/// The vertices that face the head's centre across the joint space, as rays from it.
struct Facing {
  std::vector<Vec3> rays;
  Vec3 into_socket = Vec3::Zero();  ///< sum of their directions, by area
};

Facing facing(const TriMesh& fixed, const Sphere& head) {
  const Points normals = mesh::area_normals(fixed);
  const double overlap = by_head(deepest_rim_overlap, head), space = by_head(widest_rim_space, head);
  Facing found;
  for (std::size_t v = 0; v < fixed.vertices.size(); ++v) {
    const Vec3 ray = fixed.vertices[v] - head.centre;
    const double gap = ray.norm() - head.radius;
    if (gap < -overlap || gap > space || !(normals[v].dot(ray) < 0)) continue;
    found.rays.push_back(ray);
    found.into_socket -= normals[v].dot(ray) / ray.squaredNorm() * ray;
  }
  return found;
}

///       opening           In each sector the vertex that lies farthest towards the opening
///     .    ^    .         and still faces the head's centre is the rim's.
///    (  .  |  .  )
///     \ head    /
struct Crest {
  Vec3 ray = Vec3::Zero();
  double towards_opening = -1, gap = 0;
  bool found = false;
};
using Crests = std::array<Crest, rim_sectors>;

Crests crests_of(const std::vector<Vec3>& rays, const Vec3& opening, double head_radius) {
  const Vec3 x = opening.unitOrthogonal(), y = opening.cross(x);
  Crests crests{};
  for (const Vec3& ray : rays) {
    const double turn = core::arctangent(ray.dot(y), ray.dot(x)) / (2 * std::numbers::pi) + 0.5;
    Crest& crest = crests[std::min(static_cast<std::size_t>(turn * rim_sectors), rim_sectors - 1)];
    const double towards = ray.dot(opening) / ray.norm();
    if (crest.found && towards <= crest.towards_opening) continue;
    crest = {ray, towards, ray.norm() - head_radius, true};
  }
  return crests;
}

double rim_quantile(std::vector<double> values, double q) {
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(q * static_cast<double>(values.size()));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

std::vector<double> gaps_of(const Crests& crests) {
  std::vector<double> gaps;
  for (const Crest& crest : crests)
    if (crest.found) gaps.push_back(crest.gap);
  return gaps;
}

struct Plane {
  Vec3 point, normal;
  double height(const Vec3& p) const { return (p - point).dot(normal); }
};

Plane plane_through(const std::vector<Vec3>& points, const Vec3& side) {
  Vec3 mean = Vec3::Zero();
  for (const Vec3& p : points) mean += p / static_cast<double>(points.size());
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const Vec3& p : points) spread += (p - mean) * (p - mean).transpose();
  Vec3 normal = core::axes_of(spread).directions.col(0);
  if (normal.dot(side) < 0) normal = -normal;
  return {mean, normal};
}

/// Least squares again and again without the third of the points that is farthest off: a notch is no larger.
Plane rim_plane(const Crests& crests, const Vec3& opening) {
  constexpr int rounds = 4;
  std::vector<Vec3> all;
  for (const Crest& crest : crests)
    if (crest.found) all.push_back(crest.ray);
  Plane plane = plane_through(all, opening);
  for (int round = 0; round < rounds; ++round) {
    std::vector<double> off;
    for (const Vec3& p : all) off.push_back(std::abs(plane.height(p)));
    const double most = rim_quantile(off, 2.0 / 3);
    std::vector<Vec3> near;
    for (std::size_t i = 0; i < all.size(); ++i)
      if (off[i] <= most) near.push_back(all[i]);
    plane = plane_through(near, opening);
  }
  return plane;
}

std::optional<RimPlane> plane_with_notch(const Crests& crests, const Vec3& opening, const Sphere& head) {
  /// mm of a head of the usual size; and as many sectors of the notch are averaged over either way.
  constexpr double least_notch = 4;
  constexpr std::size_t reach = 3;
  const Plane plane = rim_plane(crests, opening);
  const double usual_gap = rim_quantile(gaps_of(crests), 0.5);
  std::array<double, rim_sectors> depth{};
  for (std::size_t i = 0; i < rim_sectors; ++i)
    if (crests[i].found)
      depth[i] = std::max(crests[i].gap - usual_gap, 0.0) + std::max(-plane.height(crests[i].ray), 0.0);
  const auto around = [&](std::size_t i) {
    return depth[(i + rim_sectors - 1) % rim_sectors] + depth[i] + depth[(i + 1) % rim_sectors];
  };
  std::size_t deepest = 0;
  for (std::size_t i = 1; i < rim_sectors; ++i)
    if (around(i) > around(deepest)) deepest = i;
  if (!(around(deepest) / 3 >= by_head(least_notch, head))) return std::nullopt;
  Vec3 towards = Vec3::Zero();
  for (std::size_t k = 0; k <= 2 * reach; ++k) {
    const std::size_t i = (deepest + rim_sectors - reach + k) % rim_sectors;
    towards += depth[i] * (crests[i].ray - plane.point);
  }
  towards -= towards.dot(plane.normal) * plane.normal;
  if (!(towards.norm() > 0)) return std::nullopt;
  return RimPlane{plane.normal, towards.normalized()};
}

}  // namespace

std::optional<SocketRim> socket_rim(const TriMesh& fixed, const Sphere& head) {
  const Facing found = facing(fixed, head);
  if (!(found.into_socket.norm() > 0)) return std::nullopt;
  const Vec3 opening = -found.into_socket.normalized();
  const Crests crests = crests_of(found.rays, opening, head.radius);
  const std::vector<double> gaps = gaps_of(crests);
  if (gaps.size() < fewest_rim_sectors) return SocketRim{opening, {}, {}};
  return SocketRim{opening, rim_quantile(gaps, 0.1), plane_with_notch(crests, opening, head)};
}

}  // namespace condyle::kinematics
