#pragma once

#include <functional>

#include "condyle/fit.hpp"

namespace condyle::kinematics {

/// Patches of a cylinder's surface: so many sectors about its axis and slices along it; `slice_at` is that of a height along the
/// axis from the cylinder's point, in mm.
struct AxisPatches {
  int sectors, slices;
  std::function<int(double height)> slice_at;
};

/// Sets direction_bound and axis_bound_mm: how far the axis moves when the cylinder is fitted to other draws of its patches.
void bound_axis(const Points& vertices, const AxisPatches& patches, CylinderFit& fit);

}  // namespace condyle::kinematics
