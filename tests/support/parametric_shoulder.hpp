#pragma once

#include "condyle/joint.hpp"
#include "support/test.hpp"

/// A right shoulder of parts whose limits have closed forms: a ball with a square shaft, a slab with a shallow dish, and a plate
/// above as an acromion.

namespace condyle::test {

/// Seen from the front, Z to the left (lateral), Y up; mm.
///
///        +---------------+            acromion: lower face at acromion_y, lateral edge at acromion_z
///        +---------------+
///               .  -  .      /
///  tubercle > (        )    (  slab    dish about the joint centre
///              (  ball )     (
///               `|   |'       \    .
///                | shaft
struct ParametricShoulder {
  Vec3 head_offset = Vec3::Zero();  ///< of the ball from the joint centre; the shaft stays about that
  double dish_radius = 26;
  double acromion_y = 34;
  std::optional<Vec3> tubercle = {};  ///< apex of a spike on the ball
  int ball_levels = 4;

  static constexpr double ball_radius = 24, shaft_half_width = 8, acromion_z = 30;
  static constexpr double dish_half_angle = 35 * std::numbers::pi / 180;
};

/// A round slab, medial of the joint centre, with a dish about it.
inline TriMesh slab_with_dish(double dish_radius) {
  constexpr int rings = 30;
  constexpr double outer = 20, thickness = 20;
  std::vector<std::array<double, 2>> profile;
  for (int i = 0; i <= rings; ++i) {
    const double angle = ParametricShoulder::dish_half_angle * i / rings;
    profile.push_back({dish_radius * std::sin(angle), -dish_radius * std::cos(angle)});
  }
  const double front = profile.back()[1], back = -dish_radius - thickness;
  profile.insert(profile.end(), {{outer, front}, {outer, back}, {0, back}});
  return turned_solid(profile, 96);
}

/// A tetrahedron with this apex, its base inside the ball.
inline TriMesh spike(const Vec3& apex) {
  const Vec3 u = apex.normalized(), x = u.unitOrthogonal(), y = u.cross(x), base = 18 * u;
  TriMesh mesh;
  mesh.vertices.push_back(apex);
  for (const double turn : {0.0, 2.0, 4.0})
    mesh.vertices.push_back(base + 4 * (std::cos(turn) * x + std::sin(turn) * y));
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}};
  return mesh;
}

inline Joint shoulder(const ParametricShoulder& shape) {
  constexpr double w = ParametricShoulder::shaft_half_width;
  TriMesh humerus = joined(sphere(shape.head_offset, ParametricShoulder::ball_radius, shape.ball_levels),
                           box({-w, -200, -w}, {w, -15, w}));
  if (shape.tubercle) humerus = joined(humerus, spike(*shape.tubercle));
  const TriMesh scapula =
      joined(slab_with_dish(shape.dish_radius),
             box({-15, shape.acromion_y, -10}, {15, shape.acromion_y + 6, ParametricShoulder::acromion_z}));
  Joint joint{"right shoulder", JointKind::ball, Side::right, {"scapula", scapula}, {"humerus", humerus}};
  joint.anatomy = Anatomy::shoulder;
  return joint;
}

/// Abduction at which the lateral face of the shaft meets the lateral edge of the acromion's lower face:
///
///     rho sin(alpha - limit) = half width,    alpha: the edge's direction from -Y towards Z, rho: its distance
inline double shaft_limit(const ParametricShoulder& shape) {
  const double rho = std::hypot(shape.acromion_y, ParametricShoulder::acromion_z);
  return std::numbers::pi - std::atan2(ParametricShoulder::acromion_z, shape.acromion_y) -
         std::asin(ParametricShoulder::shaft_half_width / rho);
}

/// Elevation at which a point as high as this and as far to the side to which the arm goes meets the acromion's lower face:
///
///     rho cos(phi - limit) = acromion_y,      phi: the point's direction from Y, rho: its distance
inline double tubercle_limit(const ParametricShoulder& shape, double up, double aside) {
  return std::atan2(aside, up) - std::acos(shape.acromion_y / std::hypot(up, aside));
}

}  // namespace condyle::test
