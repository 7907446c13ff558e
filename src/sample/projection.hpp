#pragma once

#include "sample/field.hpp"

namespace condyle::sample {

/// Distance to the surface, mm, within which a laid point is left: far below any length of the model, far
/// above the rounding of coordinates of some hundred millimetres.
inline constexpr double laid_tolerance = 1e-9;

/// A point on a surface, and the field's gradient there.
struct Laid {
  Vec3 point, gradient;
};

/// The point moved onto the surface of the solid along the field's gradient, to within laid_tolerance.
///
/// Newton's step -f g / |g|^2 halves or better from anywhere near a surface whose field grows by about one
/// per millimetre; steps are limited so that a point in a thin plate is not thrown across it. Where a crease
/// makes the steps alternate, the sign change they found is bisected. Raises MeshError if neither arrives,
/// which means that the point was not near the surface.
Laid laid_on(const Field& solid, const Vec3& p);

}  // namespace condyle::sample
