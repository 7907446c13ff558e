#include "kinematics/shoulder_anatomy.hpp"

#include "condyle/error.hpp"
#include "core/formatted.hpp"
#include "kinematics/hip_anatomy.hpp"
#include "kinematics/joint_cylinder.hpp"
#include "kinematics/surface_points.hpp"

namespace condyle::kinematics {
namespace {

/// Humeral heads, mm.
constexpr double smallest_humeral_head = 14, largest_humeral_head = 34;
/// A humeral head is a third of a sphere or more.
constexpr double least_glenoid_coverage = 0.25;

/// The glenoid faces the head (cosine of 35 degrees) across the cartilages, within so many head radii of its centre.
constexpr double faces_head = 0.82, nearest = 0.85, farthest_glenoid = 1.6;
/// The sphere of the bone is as large as the head's or flatter; its area is a quarter of an adult glenoid's or more (some
/// 8 cm^2); its points are as round as that.
constexpr double smallest_glenoid_ratio = 0.9, largest_glenoid_ratio = 3, least_area_mm2 = 150,
                 most_residual_mm = 1.2;
constexpr double normals_cell = 4;

std::optional<Glenoid> find_glenoid(const TriMesh& scapula, const Sphere& head, std::string& why_none) {
  auto points = surface_points(scapula, Sphere{head.centre, farthest_glenoid * head.radius});
  const PointNeighbours neighbours(scapula, points);
  average_normals(points, normals_cell);
  std::vector<Index> facing;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec3 ray = head.centre - points[i].position;
    const double distance = ray.norm();
    if (distance >= nearest * head.radius && points[i].normal.dot(ray) >= faces_head * distance)
      facing.push_back(static_cast<Index>(i));
  }
  const auto part = neighbours.largest_connected_part(points, facing);
  Glenoid glenoid{{}, 0, Vec3::Zero()};
  for (const Index i : part) {
    glenoid.area_mm2 += points[i].area;
    glenoid.faces += points[i].area * points[i].normal;
  }
  if (glenoid.area_mm2 < least_area_mm2) {
    why_none = core::formatted("%.0f mm2 of the fixed body face the head closely (needs %.0f)",
                               glenoid.area_mm2, least_area_mm2);
    return std::nullopt;
  }
  glenoid.faces.normalize();
  try {
    glenoid.fit = fit_sphere(scapula.vertices, vertices_of(points, part));
  } catch (const MeshError& error) {
    why_none = error.what();
    return std::nullopt;
  }
  const double ratio = glenoid.fit.sphere.radius / head.radius;
  if (ratio >= smallest_glenoid_ratio && ratio <= largest_glenoid_ratio &&
      glenoid.fit.rms_residual <= most_residual_mm &&
      (glenoid.fit.sphere.centre - scapula.vertices[glenoid.fit.vertices[0]]).dot(glenoid.faces) > 0)
    return glenoid;
  why_none = core::formatted(
      "what faces the head has a sphere of %.1f head radii with rms %.1f mm (needs %.1f to %.0f, hollow, and "
      "%.1f)",
      ratio, glenoid.fit.rms_residual, smallest_glenoid_ratio, largest_glenoid_ratio, most_residual_mm);
  return std::nullopt;
}

}  // namespace

ShoulderAnatomy shoulder_anatomy(const TriMesh& scapula, const TriMesh& humerus) {
  ShoulderAnatomy shoulder;
  const auto facing = facing_part(humerus, scapula);
  if (!facing || facing->apart_mm > farthest_apart_mm) {
    shoulder.why_no_head =
        facing ? core::formatted("the bones are %.0f mm apart", facing->apart_mm) : "a bone has no surface";
    shoulder.why_no_glenoid = "no head was found";
    return shoulder;
  }
  try {
    shoulder.head = find_sphere_on(humerus, {.smallest_radius = smallest_humeral_head,
                                             .largest_radius = largest_humeral_head,
                                             .within = Sphere{facing->centre, 2 * largest_humeral_head},
                                             .resamples = 50});
    if (shoulder.head->coverage < least_glenoid_coverage) {
      shoulder.why_no_head = core::formatted("the best head has %.0f %% of a sphere (needs %.0f)",
                                             100 * shoulder.head->coverage, 100 * least_glenoid_coverage);
      shoulder.head.reset();
    } else if (*shoulder.head->centre_bound_mm > largest_place_bound_mm) {
      shoulder.why_no_head =
          core::formatted("parts of the best head give centres up to %.1f mm off (needs %.0f)",
                          *shoulder.head->centre_bound_mm, largest_place_bound_mm);
      shoulder.head.reset();
    }
  } catch (const MeshError& error) {
    shoulder.why_no_head = error.what();
  }
  if (!shoulder.head) {
    shoulder.why_no_glenoid = "no head was found";
    return shoulder;
  }
  const Sphere& head = shoulder.head->fit.sphere;
  shoulder.towards_humerus = (area_centroid(humerus) - head.centre).normalized();
  shoulder.glenoid = find_glenoid(scapula, head, shoulder.why_no_glenoid);
  return shoulder;
}

}  // namespace condyle::kinematics
