#include "kinematics/hip_anatomy.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "condyle/error.hpp"
#include "kinematics/socket_rim.hpp"
#include "kinematics/surface_points.hpp"

namespace condyle::kinematics {
namespace {

/// The socket is looked for within this many head radii of the head's centre, with a radius up to the other.
constexpr double socket_reach = 1.5;

/// The neck begins where the head's sphere ends, and is over before the trochanters spread; in head radii.
constexpr double neck_begins = 1.2, neck_ends = 1.7;

/// Where the walls of a socket are, in radii of its head, and in which share of all directions there are some at least. Of two real hips the heads have 0.40 and 0.48, spheres along a neck without its head 0.08.
constexpr double nearest_wall = 0.9, farthest_wall = 1.5, least_walls = 0.15;
/// Least share of a sphere that is a socket. A ball in it may be an implant's, of which more is there than of a head, and it is no larger than
/// its socket; its centre is so near that of the socket, in radii of the socket.
constexpr double least_socket = 0.2, least_loose_ball = 0.5, smallest_ball = 0.3, largest_ball = 1.05,
                 farthest_from_socket = 0.5;
/// A hip bone without a socket comes so near its head's centre, in radii of the head.
constexpr double nearest_bone = 2;

bool is_near(const TriMesh& hip_bone, const Sphere& head) {
  const double squared = nearest_bone * nearest_bone * head.radius * head.radius;
  for (std::size_t v = 0; v < hip_bone.vertices.size(); ++v)
    if ((hip_bone.vertices[v] - head.centre).squaredNorm() < squared) return true;
  return false;
}

/// A ball that holds all vertices, somewhat larger than it must be.
Sphere ball_around(const TriMesh& mesh) {
  Vec3 low = mesh.vertices[0], high = low;
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    low = low.cwiseMin(mesh.vertices[v]);
    high = high.cwiseMax(mesh.vertices[v]);
  }
  return {(low + high) / 2, (high - low).norm() / 2};
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

bool lies_about(const TriMesh& hip_bone, const Sphere& head) {
  const double least = nearest_wall * head.radius, most = farthest_wall * head.radius;
  double inwards = 0,
         outwards = 0;  // solid angles; of a mesh that is inside out the latter is that of the walls
  for (std::size_t t = 0; t < hip_bone.triangles.size(); ++t) {
    const Vec3 a = hip_bone.corner(t, 0) - head.centre;
    if (a.squaredNorm() > 4 * most * most) continue;
    const Vec3 b = hip_bone.corner(t, 1) - head.centre, c = hip_bone.corner(t, 2) - head.centre;
    const Vec3 ray = (a + b + c) / 3;
    const double distance = ray.norm();
    if (distance < least || distance > most) continue;
    const double facing = -(b - a).cross(c - a).dot(ray) / 2;
    (facing > 0 ? inwards : outwards) += std::abs(facing) / (distance * distance * distance);
  }
  return std::max(inwards, outwards) >= least_walls * 4 * std::numbers::pi;
}

std::optional<SphericalPatch> full_socket(const TriMesh& hip_bone) {
  return find_sphere_where(hip_bone, {.part = SphericalPart::socket},
                           [](const SphericalPatch& patch) { return patch.coverage >= least_socket; });
}

std::optional<SphericalPatch> head_in_socket(const TriMesh& hip_bone, const TriMesh& femur,
                                             std::size_t resamples, std::optional<bool> femur_is_open) {
  const auto in_socket = [&](const SphericalPatch& patch) { return lies_about(hip_bone, patch.fit.sphere); };
  if (auto head = find_sphere_where(femur, {.resamples = resamples}, in_socket, femur_is_open)) return head;
  const auto socket = full_socket(hip_bone);
  if (!socket) {
    // Near the hip bone there are no condyles.
    return find_sphere_where(
        femur, {.within = ball_around(hip_bone), .resamples = resamples},
        [&](const SphericalPatch& patch) { return is_near(hip_bone, patch.fit.sphere); }, femur_is_open);
  }
  const Sphere& cup = socket->fit.sphere;
  return find_sphere_where(femur,
                           {.smallest_radius = smallest_ball * cup.radius,
                            .largest_radius = largest_ball * cup.radius,
                            .within = Sphere{cup.centre, farthest_wall * cup.radius},
                            .resamples = resamples},
                           [&](const SphericalPatch& patch) {
                             const Sphere& ball = patch.fit.sphere;
                             const bool is_loose = ball.radius * largest_socket_in_heads < cup.radius;
                             return (ball.centre - cup.centre).norm() <= farthest_from_socket * cup.radius &&
                                    (!is_loose || patch.coverage >= least_loose_ball);
                           });
}

std::optional<HipAnatomy> hip_anatomy(const TriMesh& hip_bone, const TriMesh& femur) {
  if (hip_bone.vertices.size() == 0) return std::nullopt;
  auto found = head_in_socket(hip_bone, femur);
  if (!found) return std::nullopt;
  HipAnatomy anatomy{};
  anatomy.head = *std::move(found);
  const Sphere& head = anatomy.head.fit.sphere;
  anatomy.socket = find_socket(hip_bone, head);
  if (!anatomy.socket) {
    // A hip bone has round places too: are the bones exchanged?
    const auto other = head_in_socket(femur, hip_bone);
    if (other && other->coverage > anatomy.head.coverage && find_socket(femur, other->fit.sphere))
      return std::nullopt;
  }
  anatomy.towards_femur = (area_centroid(femur) - head.centre).normalized();
  anatomy.towards_pelvis = (area_centroid(hip_bone) - head.centre).normalized();
  anatomy.towards_neck = towards_neck(femur, head);
  anatomy.femur_end = farthest(femur, head.centre);
  anatomy.hip_bone_end = farthest(hip_bone, head.centre);
  if (const auto rim = socket_rim(hip_bone, head)) anatomy.opening = rim->opening;
  return anatomy;
}

}  // namespace condyle::kinematics
