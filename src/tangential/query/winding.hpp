#pragma once

#include "tangential/build/rings.hpp"
#include "tangential/query/circle_cells.hpp"

namespace condyle::tangential {

/// Winding number of the infinitely little shifted point of a circle, by the ray from the point outwards.
int winding_outwards(const Rings& rings, const Circle& circle, const CircleCell& cell, TangentialWork& work);

/// Winding number at a point on the axis, not on the surface: by the ray along the axis.
int winding_on_axis(const Rings& rings, const Vec3& point);

}  // namespace condyle::tangential
