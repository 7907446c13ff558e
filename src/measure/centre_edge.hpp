#pragma once

#include <optional>

#include "measure/rim.hpp"

namespace condyle::measure {

struct CentreEdge {
  double angle_deg;  ///< from superior; below 0 if the roof ends before it
  Vec3 edge;
};

struct CentreEdgeFinding {
  std::optional<CentreEdge> found;
  std::string why_none;
};

/// Where the roof of a socket ends in the plane of superior and another direction, seen from the head's centre: the wall that
/// covers superior, or nearest to it on the other side, followed towards `direction`. None if there is none within
/// 60 degrees, or if the mesh ends there. Directions are unit and at a right angle.
CentreEdgeFinding centre_edge(const SocketWall& wall, const Sphere& head, const Vec3& superior,
                              const Vec3& direction);

}  // namespace condyle::measure
