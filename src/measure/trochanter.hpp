#pragma once

#include <optional>

#include "measure/found_parts.hpp"
#include "measure/shaft_axis.hpp"

namespace condyle::measure {

struct TrochanterFinding {
  std::optional<Vec3> top;
  double height_mm = 0;  ///< over the head's centre, along the shaft
  std::string why_none;
};

/// The top of the greater trochanter: the highest point of the femur along its shaft beyond 0.7 of the way from the head's centre to
/// the shaft's axis.
///
///      top  .
///      .--.  o head     Height falls from the trochanter towards the neck: a highest point at the border of that region is
///     |    \/           the neck's, and then there is no top.
///     |  |
/// `ends` marks vertices where the mesh ends: a top there is none.
TrochanterFinding greater_trochanter(const TriMesh& femur, const Sphere& head, const ShaftAxis& shaft,
                                     const std::vector<char>& ends);

}  // namespace condyle::measure
