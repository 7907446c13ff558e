#pragma once

#include <string>
#include <vector>

#include "condyle/fit.hpp"

namespace condyle::measure {

/// The axis of a femoral neck, from the centre of the head to the foot.
struct NeckLine {
  Vec3 direction;             ///< unit
  double area_mm2;            ///< that the neck cuts from the sphere, as the length of its vector area
  std::vector<Vec3> outline;  ///< where the surface crosses the sphere, in no order; mm
};

struct NeckFinding {
  std::optional<NeckLine> neck;
  std::string why_none;
};

/// In radii of the head: there the femur is only neck, and a cam is behind.
inline constexpr double neck_sphere = 1.4;

/// The direction of the vector area of the loop in which the surface crosses a sphere about the head's centre:
///
///      _.-"-._
///     ( head  )====. loop       A = 1/2 of the integral of p x dp along it
///      `-._.-'=====' on 1.4 R
///
/// In the plane of a triangle (foot of the perpendicular q, normal N, radius rho) the loop is an arc from p0 to p1 by the
/// turn t, and adds (q x (p1 - p0) + rho^2 t N) / 2: nothing is approximated. The largest loop is the neck's; there is none if it goes over a face whose
/// corners are marked in `ends`, in which the mesh ends. Linear in the mesh.
NeckFinding find_neck(const TriMesh& femur, const Sphere& head, const std::vector<char>& ends);

}  // namespace condyle::measure
