#pragma once

#include <optional>
#include <string>
#include <vector>

#include "condyle/fit.hpp"

namespace condyle::measure {

/// The axis of a femur's shaft.
struct ShaftAxis {
  Vec3 point, direction;     ///< mm; unit, away from the head
  double first_mm, last_mm;  ///< the sections that were used, along the axis from the head's centre
  double bound_deg;  ///< of the direction: two standard errors, from how the centroids stray from the axis
};

struct ShaftFinding {
  std::optional<ShaftAxis> shaft;
  std::string why_none;
};

/// The line of the centroids of sections across it, each that of the bone's area in its plane:
///
///       head O                 Sections begin 2.6 R below the head's centre and end after 90 mm, or 6 mm before the bone does. The
///             \___.            line is that of the least sum of distances, and from there of Tukey's biweight: sections that the
///        2.6 R |  |            lesser trochanter bulges have no weight. A section whose contour does not close, or that goes
///             =+==+= sections  through an end of the mesh, is none.
///             =+==+=
///
/// Exact for the mesh as it is, so that its triangles do not matter. Linear in it. Empty with less than 25 mm, or if the direction is
/// open by more than 8 degrees.
ShaftFinding find_shaft(const TriMesh& femur, const Sphere& head, const std::vector<char>& ends);

}  // namespace condyle::measure
