#pragma once

#include <optional>
#include <vector>

#include "condyle/fit.hpp"

/// The socket of a shoulder: a glenoid covers a tenth of a sphere, where an acetabulum covers a third.

namespace condyle::kinematics {

/// A dish that faces a head across the joint space.
///
///     ________
///             |  acromion      the dish: the connected surface that faces the head's centre h,
///     -------------            nearer than anything else that does
///      \   .  -  .
///       | (       )            cone: of the directions from h to the dish
///      (  (   h - - > opening
///       | (       )
///      /   `  -  '
struct ShallowSocket {
  Vec3 middle;   ///< the mean of its vertices, mm
  Vec3 opening;  ///< unit: from the middle of the dish to the head's centre
  double
      cone_cosine;  ///< of the angle about -opening, seen from the head's centre, within which nearly all of it lies
  double coverage;  ///< the share of all directions from the head's centre in which it lies
  std::optional<SphericalPatch> sphere;  ///< fitted to it; empty if it is flat or no part of a sphere
  std::optional<double>
      rim_gap_mm;  ///< between the head's sphere and its border; empty if too little of one is seen
};

/// Looks from the head's centre at the surface that faces it within 45 degrees across a joint space of up to 10 mm. Of several
/// parts, as glenoid and acromion are, the one that covers most of the view and is nearest. Empty if it covers less than a
/// cap of 20 degrees does. Linear in the mesh.
std::optional<ShallowSocket> find_shallow_socket(const TriMesh& fixed, const Sphere& head);

/// Whether the sphere of the socket can be a socket's of this head: as large as it or up to three times, and round.
bool is_socket_of(const Sphere& head, const SphericalPatch& socket);

/// The smallest distance from the joint centre, which is the origin, to surface that lies beside the socket as the head's
/// centre sees it, mm: an acromion, a coracoid process. Without a socket all surface counts. Infinite if there is none.
/// Linear in the mesh.
double nearest_beside(const TriMesh& fixed, const Sphere& head, const std::optional<ShallowSocket>& socket);

}  // namespace condyle::kinematics
