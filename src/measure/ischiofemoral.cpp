#include "measure/ischiofemoral.hpp"

#include <algorithm>
#include <limits>
#include <vector>

#include "core/formatted.hpp"
#include "mesh/surface_to_surface.hpp"

namespace condyle::measure {
namespace {

/// In radii of the head below its centre.
constexpr double begins = 1.7, femur_ends = 3.4;
/// The lesser trochanter lies above the one, and the ischium comes nearest above the other.
constexpr double femur_needed = 2.6, ischium_needed = 2.2;

/// The part of a polygon with sign * (y - level) >= 0 (Sutherland and Hodgman 1974).
std::vector<Vec3> cut(const std::vector<Vec3>& polygon, double level, double sign) {
  std::vector<Vec3> out;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const double at_a = sign * (a.y() - level), at_b = sign * (b.y() - level);
    if (at_a >= 0) out.push_back(a);
    if ((at_a < 0) != (at_b < 0)) out.push_back(a + at_a / (at_a - at_b) * (b - a));
  }
  return out;
}

TriMesh between(const TriMesh& mesh, double low, double high) {
  TriMesh out;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    std::vector<Vec3> polygon{mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2)};
    const auto [least, most] = std::minmax({polygon[0].y(), polygon[1].y(), polygon[2].y()});
    if (most < low || least > high) continue;
    if (least < low) polygon = cut(polygon, low, 1);
    if (most > high) polygon = cut(polygon, high, -1);
    for (std::size_t k = 2; k < polygon.size(); ++k) {
      const auto first = static_cast<Index>(out.vertices.size());
      for (const Vec3& p : {polygon[0], polygon[k - 1], polygon[k]}) out.vertices.push_back(p);
      out.triangles.push_back({first, first + 1, first + 2});
    }
  }
  return out;
}

double lowest(const TriMesh& mesh) {
  double low = std::numeric_limits<double>::infinity();
  for (const Triangle& t : mesh.triangles)
    for (const Index v : t) low = std::min(low, mesh.vertices[v].y());
  return low;
}

}  // namespace

IschiofemoralFinding ischiofemoral_distance(const Bones& bones, const Sphere& head, const Pose& X_FM) {
  const double centre = head.centre.y(), radius = head.radius;
  const auto ends_early = [&](const TriMesh& mesh, double needed) {
    return lowest(mesh) > centre - needed * radius;
  };
  if (ends_early(bones.femur, femur_needed))
    return {
        {},
        {},
        core::formatted("the femur ends less than %.0f mm below the head's centre", femur_needed * radius)};
  if (ends_early(bones.hip_bone, ischium_needed))
    return {{},
            {},
            core::formatted("the hip bone ends less than %.0f mm below the head's centre",
                            ischium_needed * radius)};
  const TriMesh femur = between(bones.femur, centre - femur_ends * radius, centre - begins * radius);
  const TriMesh ischium =
      between(bones.hip_bone, -std::numeric_limits<double>::infinity(), centre - begins * radius);
  const auto closest = mesh::closest_points(mesh::TriangleTree(ischium), mesh::TriangleTree(femur), X_FM);
  if (!closest) return {{}, {}, "neither bone is below the head"};
  return {closest->distance_mm, ClosestBones{closest->a_point, closest->b_point}, {}};
}

}  // namespace condyle::measure
