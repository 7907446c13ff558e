#pragma once

#include "condyle/joint.hpp"
#include "support/test.hpp"

/// Bones whose measures have closed forms, of facets of one degree.

namespace condyle::test {

/// Along an axis and beside it, mm.
struct ProfilePoint {
  double along, beside;
};

/// A closed surface about an axis through the origin: the profile goes from a point of the axis to another one, the solid on the
/// axis's side; `facets` around.
TriMesh revolved(const Vec3& axis, const std::vector<ProfilePoint>& profile, int facets = 360);

/// The surface at a distance from the origin that depends on the direction, given as the angle from the axis and the turn about
/// it from `zero` (radians): vertices at every degree of both.
TriMesh star_shaped(const Vec3& axis, const Vec3& zero,
                    const std::function<double(double from_axis, double turn)>& distance);

/// A head of radius R whose neck is a cone of radius r0 + m x at x along the axis, cut at x = 70.
TriMesh head_with_cone(const Vec3& neck, double R, double r0, double m);

/// A cup of radius S about the origin, cut by x . opening = h, thick behind and sharp at its rim.
TriMesh sharp_cup(const Vec3& opening, double S, double h);

/// Direction of a right hip's opening by anatomic inclination and version, degrees.
Vec3 opening_of(double inclination_deg, double version_deg);

/// A right hip of these bones.
Joint hip_of(TriMesh hip_bone, TriMesh femur);

/// The other side: Z negated.
Joint mirrored_hip(const Joint& hip);

}  // namespace condyle::test
