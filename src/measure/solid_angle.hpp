#pragma once

#include <cmath>

#include "condyle/mesh.hpp"
#include "core/trigonometry.hpp"

namespace condyle::measure {

/// The solid angle of a triangle seen from a point, sr: above 0 if it faces away (Van Oosterom and Strackee 1983).
inline double solid_angle(const TriMesh& mesh, std::size_t t, const Vec3& from) {
  const Vec3 a = mesh.corner(t, 0) - from, b = mesh.corner(t, 1) - from, c = mesh.corner(t, 2) - from;
  const double la = a.norm(), lb = b.norm(), lc = c.norm();
  return 2 *
         core::arctangent(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
}

}  // namespace condyle::measure
