#pragma once

#include <cstdint>
#include <optional>

#include "condyle/error.hpp"
#include "condyle/joint.hpp"

/// Meshes that are in contact in the reference pose, as segmented ones often are, and what can be done about
/// it. Never done silently, and never by moving a mesh.

namespace condyle {

/// Treatment of two bodies that are in contact in the reference pose.
enum class ReferenceContact : std::uint8_t {
  refuse,  ///< ReferenceContactError: what can be done, and the place of greatest depth
  accept,  ///< motions that start in contact say so
};

/// Leaves out the triangles of each body that meet the other body in the reference pose, and with them `rings`
/// rings of neighbours: triangles that share a vertex with one left out, then with one of those, and so on.
/// With no ring only the crossing triangles go, and their neighbours, which barely clear each other, end most
/// motions at once.
struct LeaveOutReferenceContacts {
  int rings = 2;
};

/// Triangles excluded from contact. Triangles left out leave open meshes, and an open mesh has no inside: a body
/// wholly swallowed by the other one is then not noticed at the start of a motion, and a vertex deep in the hole
/// meets nothing. Everything else about the limits stays exact.
struct OverlapOptions {
  /// The pose in which the meshes are known: checked for contact, and the pose in which contacts are left out.
  JointAngles reference_pose = {};
  ReferenceContact reference_contact = ReferenceContact::refuse;
  std::optional<LeaveOutReferenceContacts> leave_out_reference_contacts = {};
};

/// How many triangles of each body the overlap options leave out.
struct LeftOut {
  std::size_t fixed_triangles = 0, mobile_triangles = 0;
};

/// Bodies in contact in the reference pose although the options do not cover it.
class ReferenceContactError : public MeshError {
 public:
  using MeshError::MeshError;
};

}  // namespace condyle
