#pragma once

#include <optional>

#include "condyle/fit.hpp"

namespace condyle::kinematics {

/// The plane in which a rim lies, and where it is interrupted: the acetabular notch.
struct RimPlane {
  Vec3 normal;  ///< unit, out of the socket
  Vec3 notch;   ///< unit, in the plane, from its middle
};

/// A socket as the head sees it.
struct SocketRim {
  Vec3 opening;  ///< unit: out of the socket
  std::optional<double>
      gap_mm;  ///< between the head's sphere and the rim; empty where too little of a rim is seen
  std::optional<RimPlane> plane;  ///< empty if there is no gap or no notch
};

/// Looks from the head's centre at the surface that faces it across a joint space of up to 10 mm; empty if there is
/// none. The gap is the smallest tenth of those where the socket ends, seen in sectors around its opening. The plane is
/// that of least squares through these ends, without those that are off it; the notch is where the rim is farthest from
/// the head and from the plane together, by 4 mm at least. Linear in the mesh.
std::optional<SocketRim> socket_rim(const TriMesh& fixed, const Sphere& head);

}  // namespace condyle::kinematics
