#include "kinematics/socket_rim.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace condyle::kinematics {
namespace {

/// Wider than any joint space between bones, mm: surface further off is not the socket's.
constexpr double widest_joint_space = 10;
/// How far a socket may reach into the head where the two overlap, mm.
constexpr double deepest_overlap = 2;

/// The rim is measured in so many sectors around the socket's opening, and must be found in most of them.
constexpr std::size_t sectors = 36, fewest_sectors = 24;

/// The vertices that face the head's centre across the joint space, as rays from it.
struct Facing {
  std::vector<Vec3> rays;
  Vec3 into_socket = Vec3::Zero();  ///< sum of their directions, by area
};

Facing facing(const TriMesh& fixed, const Sphere& head) {
  Points normals(fixed.vertices.size());
  for (std::size_t t = 0; t < fixed.triangles.size(); ++t) {
    const Vec3 a = fixed.corner(t, 0);
    const Vec3 normal = (fixed.corner(t, 1) - a).cross(fixed.corner(t, 2) - a);
    for (const Index v : fixed.triangles[t]) normals.set(v, normals[v] + normal);
  }
  Facing found;
  for (std::size_t v = 0; v < fixed.vertices.size(); ++v) {
    const Vec3 ray = fixed.vertices[v] - head.centre;
    const double gap = ray.norm() - head.radius;
    if (gap < -deepest_overlap || gap > widest_joint_space || !(normals[v].dot(ray) < 0)) continue;
    found.rays.push_back(ray);
    found.into_socket -= normals[v].dot(ray) / ray.squaredNorm() * ray;
  }
  return found;
}

///       opening           In each sector the vertex that lies farthest towards the opening
///     .    ^    .         and still faces the head's centre is the rim's.
///    (  .  |  .  )
///     \ head    /
std::optional<double> rim_gap(const std::vector<Vec3>& rays, const Vec3& opening, double head_radius) {
  const Vec3 x = opening.unitOrthogonal(), y = opening.cross(x);
  struct Crest {
    double towards_opening = -1, gap = 0;
    bool found = false;
  };
  std::array<Crest, sectors> crests{};
  for (const Vec3& ray : rays) {
    const double turn = std::atan2(ray.dot(y), ray.dot(x)) / (2 * std::numbers::pi) + 0.5;
    Crest& crest = crests[std::min(static_cast<std::size_t>(turn * sectors), sectors - 1)];
    const double towards = ray.dot(opening) / ray.norm();
    if (crest.found && towards <= crest.towards_opening) continue;
    crest = {towards, ray.norm() - head_radius, true};
  }
  std::vector<double> gaps;
  for (const Crest& crest : crests)
    if (crest.found) gaps.push_back(crest.gap);
  if (gaps.size() < fewest_sectors) return std::nullopt;
  const auto tenth = gaps.begin() + static_cast<std::ptrdiff_t>(gaps.size() / 10);
  std::nth_element(gaps.begin(), tenth, gaps.end());
  return *tenth;
}

}  // namespace

std::optional<SocketRim> socket_rim(const TriMesh& fixed, const Sphere& head) {
  const Facing found = facing(fixed, head);
  if (!(found.into_socket.norm() > 0)) return std::nullopt;
  const Vec3 opening = -found.into_socket.normalized();
  return SocketRim{opening, rim_gap(found.rays, opening, head.radius)};
}

}  // namespace condyle::kinematics
