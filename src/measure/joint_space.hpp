#pragma once

#include <optional>
#include <string>

#include "measure/found_parts.hpp"

namespace condyle::measure {

struct JointSpace {
  double least_mm, median_mm;
  ClosestBones at;  ///< of the least
};

struct JointSpaceFinding {
  std::optional<JointSpace> space;
  std::string why_none;
};

/// Radial gaps between a head and its socket: along the ray from the head's centre to each vertex on the socket's sphere, from the
/// femur's surface to the vertex; below 0 if they overlap. The median counts each vertex with its area. The femur stands in its zero pose.
JointSpaceFinding joint_space(const Bones& bones, const Sphere& head, const std::vector<Index>& socket);

}  // namespace condyle::measure
