#include "kinematics/hip_anatomy.hpp"

#include <algorithm>

#include "condyle/error.hpp"
#include "kinematics/socket_rim.hpp"
#include "kinematics/surface_points.hpp"

namespace condyle::kinematics {
namespace {

/// The socket is looked for within this many head radii of the head's centre, with a radius up to the other.
constexpr double socket_reach = 1.5;

/// The neck begins where the head's sphere ends, and is over before the trochanters spread; in head radii.
constexpr double neck_begins = 1.2, neck_ends = 1.7;

/// A ball that holds all vertices, somewhat larger than it must be.
Sphere ball_around(const TriMesh& mesh) {
  Vec3 low = mesh.vertices[0], high = low;
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    low = low.cwiseMin(mesh.vertices[v]);
    high = high.cwiseMax(mesh.vertices[v]);
  }
  return {(low + high) / 2, (high - low).norm() / 2};
}

/// The mean direction from the head's centre, by area, of the surface at the neck's distance.
std::optional<Vec3> towards_neck(const TriMesh& femur, const Sphere& head) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t t = 0; t < femur.triangles.size(); ++t) {
    const Vec3 a = femur.corner(t, 0), b = femur.corner(t, 1), c = femur.corner(t, 2);
    const Vec3 ray = (a + b + c) / 3 - head.centre;
    const double distance = ray.norm() / head.radius;
    if (distance >= neck_begins && distance <= neck_ends)
      sum += (b - a).cross(c - a).norm() * ray.normalized();
  }
  if (!(sum.norm() > 0)) return std::nullopt;
  return sum.normalized();
}

Vec3 farthest(const TriMesh& mesh, const Vec3& from) {
  Vec3 ray = Vec3::Zero();
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
    if (const Vec3 other = mesh.vertices[v] - from; other.squaredNorm() > ray.squaredNorm()) ray = other;
  return ray;
}

}  // namespace

Vec3 area_centroid(const TriMesh& mesh) {
  Vec3 moment = Vec3::Zero();
  double area = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Vec3 a = mesh.corner(t, 0), b = mesh.corner(t, 1), c = mesh.corner(t, 2);
    const double size = (b - a).cross(c - a).norm() / 2;
    area += size;
    moment += size * ((a + b + c) / 3);
  }
  return area > 0 ? Vec3(moment / area) : moment;
}

bool fits_into(const Sphere& head, const SphericalPatch& socket) {
  // Cartilages that touch or are pressed by some tenths of a millimetre fit too.
  constexpr double pressed_mm = 0.5;
  return head.radius <=
         socket.fit.sphere.radius + std::max(socket.fit.rms_residual, by_head(pressed_mm, head));
}

std::optional<SphericalPatch> sphere_around(const TriMesh& fixed, const Sphere& head, std::size_t resamples) {
  try {
    return find_socket_round(fixed, head,
                             {.part = SphericalPart::socket,
                              .smallest_radius = 0.9 * head.radius,
                              .largest_radius = largest_socket_in_heads * head.radius,
                              .within = Sphere{head.centre, socket_reach * head.radius},
                              .resamples = resamples});
  } catch (const MeshError&) {
    return std::nullopt;
  }
}

std::optional<SphericalPatch> find_socket(const TriMesh& fixed, const Sphere& head) {
  auto found = sphere_around(fixed, head);
  if (found && !fits_into(head, *found)) return std::nullopt;
  return found;
}

std::optional<HipAnatomy> hip_anatomy(const TriMesh& hip_bone, const TriMesh& femur) {
  if (hip_bone.vertices.size() == 0) return std::nullopt;
  HipAnatomy anatomy{};
  try {
    // Near the hip bone there are no condyles.
    anatomy.head = find_sphere_on(femur, {.within = ball_around(hip_bone)});
  } catch (const MeshError&) {
    return std::nullopt;
  }
  const Sphere& head = anatomy.head.fit.sphere;
  anatomy.socket = find_socket(hip_bone, head);
  anatomy.towards_femur = (area_centroid(femur) - head.centre).normalized();
  anatomy.towards_pelvis = (area_centroid(hip_bone) - head.centre).normalized();
  anatomy.towards_neck = towards_neck(femur, head);
  anatomy.femur_end = farthest(femur, head.centre);
  anatomy.hip_bone_end = farthest(hip_bone, head.centre);
  if (const auto rim = socket_rim(hip_bone, head)) anatomy.opening = rim->opening;
  return anatomy;
}

}  // namespace condyle::kinematics
