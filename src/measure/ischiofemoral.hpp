#pragma once

#include <optional>
#include <string>

#include "measure/found_parts.hpp"

namespace condyle::measure {

struct IschiofemoralFinding {
  std::optional<double> distance_mm;
  std::optional<ClosestBones> at;
  std::string why_none;
};

/// The least distance of the femur's part from 1.7 to 3.4 head radii below the head's centre, where the lesser trochanter is, from the
/// hip bone's below 1.7, with the femur at a pose. Parts are cut where the planes pass, below being along the frames' vertical.
IschiofemoralFinding ischiofemoral_distance(const Bones& bones, const Sphere& head, const Pose& X_FM);

}  // namespace condyle::measure
