#pragma once

#include "condyle/sample/hip.hpp"
#include "sample/field.hpp"

/// Measures of the solids of sample hips themselves, without a mesh: where their shape, as it is asked for, is not the parameter.

namespace condyle::test {

/// Where the roof ends in the frontal section, seen from the head's centre, as an angle from superior, degrees: by bisection of the
/// field.
double lateral_edge_of_shape(const sample::Field& hip_bone, double head_radius);

/// The same in closed form, where only one of the rim's two seams is at the edge (docs/mathematics/11-measures.md).
double lateral_edge_by_formula(const sample::HipParameters& hip);

/// Direction of the vector area that the femur's solid cuts from the sphere of this radius about the origin, from the head's centre to
/// the foot: the integral of the normal over the part of the sphere that is inside.
Vec3 neck_of_shape(const sample::Field& femur, const Vec3& about, double radius);

/// Alpha of the femur's solid in a half-plane of a neck's axis: from the neck, the first angle at which no solid is farther from the
/// centre than the head's radius and the tolerance; degrees.
double alpha_of_shape(const sample::Field& femur, double head_radius, const Vec3& neck, const Vec3& out,
                      double tolerance_mm);

}  // namespace condyle::test
