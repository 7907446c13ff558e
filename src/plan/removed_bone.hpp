#pragma once

#include <vector>

#include "plan/cut_surface.hpp"

namespace condyle::plan {

/// The volume between a surface as it was and as it is lowered now, mm³: signed tetrahedra, never depth times area.
double removed_mm3(const CutSurface& surface);

/// The area of the surface as it was where the cut is deeper than a per cent of its deepest place, mm².
double removed_mm2(const CutSurface& surface);

/// The share of the removed volume that the other bone sweeps over on the way to the targets: by samples in layers.
double swept_share(const CutSurface& surface, const std::vector<SweepTo>& targets);

}  // namespace condyle::plan
