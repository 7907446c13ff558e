#pragma once

#include "condyle/pose.hpp"

namespace condyle::contact {

/// The vector scaled to length 1; zero for zero.
inline Vec3 unit(const Vec3& v) {
  const double length = v.norm();
  return length > 0 ? Vec3(v / length) : Vec3(Vec3::Zero());
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
