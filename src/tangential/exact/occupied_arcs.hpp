#pragma once

#include <span>
#include <vector>

#include "condyle/tangential.hpp"
#include "tangential/exact/circle_crossing.hpp"

namespace condyle::tangential {

/// The arcs of a circle on which the winding number is positive, ascending, appended to `arcs`. `winding` is
/// that just ahead of the point; `crossings` are sorted, and sum to zero. Crossings at one angle act
/// together. Beyond that double arithmetic orders them: where surfaces coincide without sharing edges, or the
/// circle touches the solid in one point, an arc or a gap no longer than the crossings' error may or may not
/// appear.
void append_arcs(int winding, std::span<const CircleCrossing> crossings, std::vector<OccupiedArc>& arcs);

/// The gap at the point itself.
AngularGap gap_at_point(int winding, std::span<const CircleCrossing> crossings) noexcept;

}  // namespace condyle::tangential
