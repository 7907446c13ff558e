#pragma once

#include "condyle/pose.hpp"

namespace condyle::contact {

/// Of length 1; zero of zero.
inline Vec3 unit(const Vec3& v) {
  const double length = v.norm();
  return length > 0 ? Vec3(v / length) : Vec3(Vec3::Zero());
}

/// A direction turned by a pose, its products summed in one order whatever the instruction set, as by posed().
inline Vec3 turned(const Pose& X, const Vec3& v) noexcept {
  const auto& m = X.matrix();
  const auto row = [&](int i) { return (m(i, 0) * v.x() + m(i, 1) * v.y()) + m(i, 2) * v.z(); };
  return {row(0), row(1), row(2)};
}

/// How the way along a ray to a plane changes when the plane is translated. The ray from o along u meets the plane with normal m
/// through a at d = (a - o).m / (u.m): translated by s, d grows by s.m / (u.m). Rays outwards have the opposite direction and the
/// opposite depth, so one formula serves both.
inline Vec3 depth_gradient(const Vec3& normal, const Vec3& direction) {
  return normal / direction.dot(normal);
}

}  // namespace condyle::contact
