#pragma once

#include <optional>
#include <string>
#include <vector>

#include "measure/found_parts.hpp"

namespace condyle::measure {

/// Twelve hours in steps of ten minutes; and how many of them a plane needs.
inline constexpr std::size_t rim_steps = 72, fewest_rim_steps = 48;
/// Wall farther than this outside the head's sphere is not the socket's, mm: 8 and 12 give the same to 0.7 degrees.
inline constexpr double farthest_wall_mm = 10;

/// The socket's wall: triangles that face the head's centre and reach within the head's radius and farthest_wall_mm of it.
struct SocketWall {
  TriMesh mesh;
  std::vector<char> ends;       ///< of its vertices, BoneParts::hip_bone_ends
  std::vector<double> edge_mm;  ///< of its vertices: the mean edge of the wall's triangles there
};
SocketWall socket_wall(const TriMesh& hip_bone, const Sphere& head, const std::vector<char>& ends);

/// Caveat of an angle to this point of the wall: between coarse triangles its edge is cut off. Empty if there is none.
std::string edge_grain_note(const SocketWall& wall, const Sphere& head, const Vec3& point);

/// The rim of a socket and its plane.
///
///          rim  . theta        In each half-plane about the opening the rim is the wall's farthest point towards it, seen from
///            .-`|              the head's centre: the one at the largest angle theta from the inward axis.
///           (   o-----> opening        Where the mesh ends there, the rim is not in it, and the hour has no point.
///            `-.|
struct RimFinding {
  std::vector<RimHour> hours;  ///< about the plane's normal if there is one
  std::optional<RimGeometry> plane;
  std::string why_none;
};

/// The plane is that of the least sum of distances, and from there the one of Tukey's biweight, which drops a notch; the rim is
/// found anew about the plane's normal, and the plane from that. `opening` is the first one.
RimFinding find_rim(const SocketWall& wall, const Sphere& head, const Vec3& opening, const BodyAxes& axes);

}  // namespace condyle::measure
