#pragma once

#include <optional>

#include "condyle/fit.hpp"

namespace condyle::kinematics {

/// A socket as the head sees it.
struct SocketRim {
  Vec3 opening;  ///< unit: out of the socket
  std::optional<double>
      gap_mm;  ///< between the head's sphere and the rim; empty where too little of a rim is seen
};

/// Looks from the head's centre at the surface that faces it across a joint space of up to 10 mm; empty where there is
/// none. The gap is the smallest tenth of those where the socket ends, seen in sectors around its opening. Linear in
/// the mesh.
std::optional<SocketRim> socket_rim(const TriMesh& fixed, const Sphere& head);

}  // namespace condyle::kinematics
