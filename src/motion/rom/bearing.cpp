#include "condyle/bearing.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>

#include "condyle/error.hpp"

namespace condyle {
namespace {

/// A head whose centre is near the joint centre lies within two of the largest radii that find_sphere() looks for; fewer
/// vertices to search cost less.
constexpr double largest_head_reach = 90;

/// The socket is looked for within this many head radii of the head's centre, with a radius up to the other.
constexpr double socket_reach = 1.5, largest_socket = 1.4;

/// Wider than any joint space between bones, mm: surface further off is not the socket's.
constexpr double widest_joint_space = 10;
/// How far a socket may reach into the head where the two overlap, mm.
constexpr double deepest_overlap = 2;

/// The rim is measured in so many sectors around the socket's opening, and must be found in most of them.
constexpr std::size_t rim_sectors = 36, fewest_rim_sectors = 24;

std::string text(const char* format, double a, double b = 0) {
  std::array<char, 160> line{};
  std::snprintf(line.data(), line.size(), format, a, b);
  return line.data();
}

/// The vertices of the fixed body that face the head's centre across the joint space.
class SocketSeenFrom {
 public:
  SocketSeenFrom(const TriMesh& fixed, const Sphere& head) : head_(head) {
    Points normals(fixed.vertices.size());
    for (std::size_t t = 0; t < fixed.triangles.size(); ++t) {
      const Vec3 a = fixed.corner(t, 0);
      const Vec3 normal = (fixed.corner(t, 1) - a).cross(fixed.corner(t, 2) - a);
      for (const Index v : fixed.triangles[t]) normals.set(v, normals[v] + normal);
    }
    for (std::size_t v = 0; v < fixed.vertices.size(); ++v) {
      const Vec3 ray = fixed.vertices[v] - head.centre;
      const double gap = ray.norm() - head.radius;
      if (gap < -deepest_overlap || gap > widest_joint_space || !(normals[v].dot(ray) < 0)) continue;
      rays_.push_back(ray);
      facing_ -= normals[v].dot(ray) / (ray.squaredNorm()) * ray;
    }
  }

  /// The smallest tenth of the gaps where the socket ends, seen in sectors around its opening.
  ///
  ///       opening           In each sector the vertex that lies farthest towards the opening
  ///     .    ^    .         and still faces the head's centre is the rim's.
  ///    (  .  |  .  )
  ///     \ head    /
  std::optional<double> rim_gap_mm() const {
    if (rays_.empty() || !(facing_.norm() > 0)) return std::nullopt;
    const Vec3 opening = -facing_.normalized(), x = opening.unitOrthogonal(), y = opening.cross(x);
    struct Crest {
      double towards_opening = -1, gap = 0;
      bool found = false;
    };
    std::array<Crest, rim_sectors> crests{};
    for (const Vec3& ray : rays_) {
      const double turn = std::atan2(ray.dot(y), ray.dot(x)) / (2 * std::numbers::pi) + 0.5;
      Crest& crest = crests[std::min(static_cast<std::size_t>(turn * rim_sectors), rim_sectors - 1)];
      const double towards = ray.dot(opening) / ray.norm();
      if (crest.found && towards <= crest.towards_opening) continue;
      crest = {towards, ray.norm() - head_.radius, true};
    }
    std::vector<double> gaps;
    for (const Crest& crest : crests)
      if (crest.found) gaps.push_back(crest.gap);
    if (gaps.size() < fewest_rim_sectors) return std::nullopt;
    const auto tenth = gaps.begin() + static_cast<std::ptrdiff_t>(gaps.size() / 10);
    std::nth_element(gaps.begin(), tenth, gaps.end());
    return *tenth;
  }

 private:
  Sphere head_;
  std::vector<Vec3> rays_;
  Vec3 facing_ = Vec3::Zero();  ///< into the socket, by area
};

std::optional<Sphere> fitted_socket(const TriMesh& fixed, const Sphere& head) {
  try {
    return find_sphere(fixed, {.part = SphericalPart::socket,
                               .smallest_radius = 0.9 * head.radius,
                               .largest_radius = largest_socket * head.radius,
                               .within = Sphere{head.centre, socket_reach * head.radius}})
        .fit.sphere;
  } catch (const MeshError&) {
    return std::nullopt;
  }
}

std::vector<std::uint8_t> triangles_within(const TriMesh& mesh, const Vec3& centre, double radius) {
  std::vector<std::uint8_t> near_centre(mesh.vertices.size());
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
    near_centre[v] = (mesh.vertices[v] - centre).norm() <= radius;
  std::vector<std::uint8_t> within(mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto [a, b, c] = mesh.triangles[t];
    within[t] = near_centre[a] & near_centre[b] & near_centre[c];
  }
  return within;
}

}  // namespace

std::size_t BearingSurface::count() const noexcept {
  return static_cast<std::size_t>(std::count(triangles.begin(), triangles.end(), 1));
}

bool BearingSurface::holds(const TriMesh& mobile, const Feature& feature) const noexcept {
  if (feature.kind == FeatureKind::face) return triangles[feature.id] != 0;
  bool used = false;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const Triangle& corners = mobile.triangles[t];
    const auto has = [&](Index v) { return std::find(corners.begin(), corners.end(), v) != corners.end(); };
    if (!has(feature.id) || (feature.kind == FeatureKind::edge && !has(feature.other_end))) continue;
    if (!triangles[t]) return false;
    used = true;
  }
  return used;
}

BearingFinding find_bearing_surface(const Joint& joint, const BearingOptions& options) {
  const auto none = [](std::string why) { return BearingFinding{std::nullopt, std::move(why)}; };
  if (options.margin_mm && !(*options.margin_mm >= 0 && std::isfinite(*options.margin_mm)))
    throw UsageError("bearing margin: must be 0 mm or more");
  if (joint.kind != JointKind::ball) return none("a hinge has no head");
  const TriMesh& mobile = joint.mobile.mesh;
  if (options.surface) {
    if (options.surface->triangles.size() != mobile.triangles.size())
      throw UsageError("bearing surface: it is that of another mesh");
    return {options.surface, {}};
  }
  BearingSurface surface;
  try {
    const SphericalPatch patch = find_sphere(mobile, {.within = Sphere{Vec3::Zero(), largest_head_reach}});
    surface.head = patch.fit.sphere;
    surface.head_coverage = patch.coverage;
  } catch (const MeshError&) {
    return none(joint.mobile.name + ": no head was found around the joint centre");
  }
  if (const double off = surface.head.centre.norm(); off > farthest_head_centre_mm)
    return none(joint.mobile.name +
                text(": the sphere found as its head has its centre %.1f mm from the joint centre, "
                     "more than %g",
                     off, farthest_head_centre_mm));
  surface.rim_gap_mm = SocketSeenFrom(joint.fixed.mesh, surface.head).rim_gap_mm();
  surface.margin_mm = options.margin_mm.value_or(
      std::min(usual_bearing_margin_mm,
               surface.rim_gap_mm.value_or(usual_bearing_margin_mm + rim_reserve_mm) - rim_reserve_mm));
  if (!(surface.margin_mm >= 0))
    return none(text("head and rim are only %.2f mm apart: no margin to tell bearing surfaces by",
                     *surface.rim_gap_mm));
  surface.triangles = triangles_within(mobile, surface.head.centre, surface.head.radius + surface.margin_mm);
  if (surface.count() == surface.triangles.size())
    return none(joint.mobile.name + ": all of it would be bearing surface");
  surface.socket = fitted_socket(joint.fixed.mesh, surface.head);
  return {std::move(surface), {}};
}

}  // namespace condyle
