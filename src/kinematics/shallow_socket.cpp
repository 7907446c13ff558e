#include "kinematics/shallow_socket.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include "condyle/error.hpp"
#include "core/trigonometry.hpp"
#include "kinematics/surface_points.hpp"
#include "mesh/disjoint_sets.hpp"
#include "mesh/triangle_distance.hpp"

namespace condyle::kinematics {
namespace {

/// mm of a head of the usual size, as of a hip's rim: surface farther off is not the socket's, and the two may overlap by as much.
constexpr double widest_joint_space = 10, deepest_overlap = 2;

/// Cosine of the 45 degrees within which a dish faces the head's centre: a glenoid of twice the head's radius is off by 20
/// degrees at its rim, and the steps of voxels turn normals by some 30.
constexpr double least_facing = 0.7;
/// ... and of the 30 degrees within which its border still does: what rounds off or is flat around it does not.
constexpr double border_facing = 0.866;

/// Share of all directions: a cap of 20 degrees. A glenoid has a twelfth.
constexpr double least_coverage = 0.03;

/// The rim is measured in so many sectors around the opening, and must be found in most of them; its gap is the smallest
/// tenth of theirs.
constexpr std::size_t sectors = 36, fewest_sectors = 24;
constexpr double gap_quantile = 0.1;

/// Share of the dish's vertices within its cone. A rim goes on rounding off for some millimetres beyond it.
constexpr double cone_share = 0.95, beyond_rim = 15 * std::numbers::pi / 180;

/// Flat glenoids of bone have up to twice the radius of their heads; beyond, and where residuals are above this share of the
/// radius, a sphere says nothing.
constexpr double largest_ratio = 3, smallest_ratio = 0.9, largest_residual = 0.05;

/// A triangle as seen from the head's centre.
struct View {
  double solid_angle = 0;  ///< above 0 if it faces the centre; of its middle
  double gap = 0;
  double cosine = 0;       ///< between its normal and the ray to the centre
  bool is_facing = false;  ///< within 45 degrees, and across a joint space
};

View view_of(const TriMesh& mesh, std::size_t t, const Sphere& head) {
  const Vec3 a = mesh.corner(t, 0) - head.centre, b = mesh.corner(t, 1) - head.centre,
             c = mesh.corner(t, 2) - head.centre;
  const Vec3 area = (b - a).cross(c - a) / 2, middle = (a + b + c) / 3;
  const double distance = middle.norm(), towards = -area.dot(middle) / distance;
  View view{towards / (distance * distance), distance - head.radius, towards / area.norm()};
  const auto [low, high] = std::minmax({a.norm(), b.norm(), c.norm()});
  view.is_facing = view.cosine > least_facing && low - head.radius >= -by_head(deepest_overlap, head) &&
                   high - head.radius <= by_head(widest_joint_space, head);
  return view;
}

/// The vertices of the part that covers most and is nearest, those within its border, and the share of directions that it covers.
struct Dish {
  std::vector<Index> vertices, within_border;
  double coverage = 0;
};

Dish dish_facing(const TriMesh& fixed, const Sphere& head) {
  mesh::DisjointSets sets(fixed.vertices.size());
  std::vector<std::pair<std::size_t, View>> facing;
  for (std::size_t t = 0; t < fixed.triangles.size(); ++t) {
    const View view = view_of(fixed, t, head);
    if (!view.is_facing) continue;
    facing.emplace_back(t, view);
    const auto [i, j, k] = fixed.triangles[t];
    sets.join(i, j), sets.join(j, k);
  }
  struct Part {
    double solid_angle = 0, score = 0;
  };
  std::map<Index, Part> parts;
  for (const auto& [t, view] : facing) {
    Part& part = parts[sets.find(fixed.triangles[t][0])];
    part.solid_angle += view.solid_angle;
    part.score += view.solid_angle * (by_head(widest_joint_space, head) - view.gap);
  }
  const auto best = std::max_element(parts.begin(), parts.end(), [](const auto& a, const auto& b) {
    return a.second.score < b.second.score;
  });
  if (best == parts.end()) return {};
  Dish dish{{}, {}, best->second.solid_angle / (4 * std::numbers::pi)};
  for (const auto& [t, view] : facing) {
    if (sets.find(fixed.triangles[t][0]) != best->first) continue;
    for (const Index v : fixed.triangles[t]) {
      dish.vertices.push_back(v);
      if (view.cosine > border_facing) dish.within_border.push_back(v);
    }
  }
  for (std::vector<Index>* some : {&dish.vertices, &dish.within_border}) {
    std::sort(some->begin(), some->end());
    some->erase(std::unique(some->begin(), some->end()), some->end());
  }
  return dish;
}

double quantile(std::vector<double> values, double q) {
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(q * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

/// The sphere through the vertices, again without those that are off it: a border is rounded, a middle may be worn.
std::optional<SphericalPatch> sphere_through(const TriMesh& fixed, const std::vector<Index>& dish) {
  constexpr int rounds = 5;
  constexpr double deviations_kept = 3, narrowest_band = 1e-6;
  try {
    std::vector<Index> kept = dish;
    for (int round = 0; round < rounds; ++round) {
      const Sphere sphere = fit_sphere(fixed.vertices, kept).sphere;
      const auto residual = [&](Index v) {
        return (fixed.vertices[v] - sphere.centre).norm() - sphere.radius;
      };
      std::vector<double> residuals;
      for (const Index v : dish) residuals.push_back(residual(v));
      const double band =
          std::max(deviations_kept * robust_deviation(std::move(residuals)), narrowest_band * sphere.radius);
      std::vector<Index> next;
      std::copy_if(dish.begin(), dish.end(), std::back_inserter(next),
                   [&](Index v) { return std::abs(residual(v)) <= band; });
      if (next == kept) break;
      kept = std::move(next);
    }
    return patch_of(fixed, kept);
  } catch (const MeshError&) {
    return std::nullopt;
  }
}

/// The border's gap that a tenth of its gaps are below; a border is what lies farthest towards the opening in its sector.
std::optional<double> rim_gap(const TriMesh& fixed, const std::vector<Index>& within, const Vec3& opening,
                              const Sphere& head) {
  struct Crest {
    double towards_opening = -2, gap = 0;
  };
  std::array<Crest, sectors> crests{};
  const Vec3 x = opening.unitOrthogonal(), y = opening.cross(x);
  for (const Index v : within) {
    const Vec3 ray = fixed.vertices[v] - head.centre;
    const double turn = core::arctangent(ray.dot(y), ray.dot(x)) / (2 * std::numbers::pi) + 0.5;
    Crest& crest = crests[std::min(static_cast<std::size_t>(turn * sectors), sectors - 1)];
    const double towards = ray.dot(opening) / ray.norm();
    if (towards > crest.towards_opening) crest = {towards, ray.norm() - head.radius};
  }
  std::vector<double> gaps;
  for (const Crest& crest : crests)
    if (crest.towards_opening > -2) gaps.push_back(crest.gap);
  if (gaps.size() < fewest_sectors) return std::nullopt;
  return quantile(std::move(gaps), gap_quantile);
}

}  // namespace

std::optional<ShallowSocket> find_shallow_socket(const TriMesh& fixed, const Sphere& head) {
  const Dish dish = dish_facing(fixed, head);
  if (dish.coverage < least_coverage) return std::nullopt;
  Vec3 into_dish = Vec3::Zero(), middle = Vec3::Zero();
  for (const Index v : dish.vertices) {
    into_dish += (fixed.vertices[v] - head.centre).normalized();
    middle += fixed.vertices[v] / static_cast<double>(dish.vertices.size());
  }
  ShallowSocket socket{
      middle, -into_dish.normalized(), 0, dish.coverage, sphere_through(fixed, dish.vertices), {}};
  std::vector<double> off_axis;  // negative cosines: the widest last
  for (const Index v : dish.vertices)
    off_axis.push_back((fixed.vertices[v] - head.centre).normalized().dot(socket.opening));
  socket.cone_cosine = -quantile(std::move(off_axis), cone_share);
  socket.rim_gap_mm = rim_gap(fixed, dish.within_border, socket.opening, head);
  return socket;
}

bool is_socket_of(const Sphere& head, const SphericalPatch& socket) {
  const double radius = socket.fit.sphere.radius;
  return radius >= smallest_ratio * head.radius && radius <= largest_ratio * head.radius &&
         socket.fit.rms_residual <= largest_residual * radius;
}

double nearest_beside(const TriMesh& fixed, const Sphere& head, const std::optional<ShallowSocket>& socket) {
  double nearest = std::numeric_limits<double>::infinity();
  const double cone =
      socket ? core::cosine(std::min(std::numbers::pi, core::arccosine(socket->cone_cosine) + beyond_rim))
             : 2;
  for (std::size_t t = 0; t < fixed.triangles.size(); ++t) {
    const std::array corners{fixed.corner(t, 0), fixed.corner(t, 1), fixed.corner(t, 2)};
    const Vec3 point = mesh::nearest_on_triangle(Vec3::Zero(), corners);
    if (point.norm() >= nearest) continue;
    if (socket && -(point - head.centre).normalized().dot(socket->opening) >= cone) continue;
    nearest = point.norm();
  }
  return nearest;
}

}  // namespace condyle::kinematics
