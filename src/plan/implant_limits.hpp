#pragma once

#include "condyle/implant.hpp"

namespace condyle::plan {

/// The half-angle at which a neck meets a liner, and between what it is for meshes with so many facets around.
struct HalfAngles {
  Angle exact, of_facets_low, of_facets_high;
};

/// A facet's plane lies inside the body of revolution it is made of, at most by the share 1 - cos(pi / facets) of the distance from the
/// axis, in the middle of a chord: so the mesh lies between both bodies, and its half-angle between theirs.
HalfAngles half_angles(const LinerShape& liner, const NeckShape& neck, int facets) noexcept;

}  // namespace condyle::plan
