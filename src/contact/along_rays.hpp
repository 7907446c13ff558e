#pragma once

#include <array>
#include <cmath>

#include "condyle/mesh.hpp"
#include "core/trigonometry.hpp"

namespace condyle::contact {

/// The vector scaled to length 1; zero for zero.
inline Vec3 unit(const Vec3& v) {
  const double length = v.norm();
  return length > 0 ? Vec3(v / length) : Vec3(Vec3::Zero());
}

/// The area of a face along its normal.
inline Vec3 area_vector(const TriMesh& mesh, std::size_t face) {
  const Vec3 a = mesh.corner(face, 0);
  return (mesh.corner(face, 1) - a).cross(mesh.corner(face, 2) - a) / 2;
}

/// The angle of a triangle at one of its corners, radians.
inline double angle_at(const std::array<Vec3, 3>& corners, std::size_t k) {
  const Vec3 a = corners[(k + 1) % 3] - corners[k], b = corners[(k + 2) % 3] - corners[k];
  return core::arctangent(a.cross(b).norm(), a.dot(b));
}

/// The cosine of `oblique_ray`: a ray that meets the target at a smaller one to its normal has no depth.
constexpr double oblique_cosine = 0.5;

/// How the way along a ray to a plane changes when the plane is translated. The ray from o along u meets the plane with normal m
/// through a at d = (a - o).m / (u.m): translated by s, d grows by s.m / (u.m). Rays outwards have the opposite direction and the
/// opposite depth, so one formula serves both.
inline Vec3 depth_gradient(const Vec3& normal, const Vec3& direction) {
  return normal / direction.dot(normal);
}

}  // namespace condyle::contact
