#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "condyle/articular_region.hpp"
#include "condyle/error.hpp"
#include "condyle/joint.hpp"

/// Meshes that touch or overlap at rest, as segmented ones do, and what can be done about it. Never done
/// silently, and never by moving a mesh.

namespace condyle {

/// What becomes of two bodies that are in contact at rest.
enum class ContactAtRest : std::uint8_t {
  refuse,  ///< MeshError: what can be done, and where it is deepest
  accept,  ///< motions that start in contact say so
};

/// Leaves out the triangles of each body that meet the other body at the rest pose, and with them `rings`
/// rings of neighbours: triangles that share a vertex with one left out, then with one of those, and so on.
/// With no ring only the crossing triangles go, and their neighbours, which barely clear each other, end most
/// motions at once.
struct LeaveOutRestContacts {
  int rings = 2;
};

/// What is not to count as contact. Triangles left out leave open meshes, and an open mesh has no inside: a
/// body wholly swallowed by the other one is then not noticed at the start of a motion, and a vertex deep in
/// the hole touches nothing. Everything else about the limits stays exact.
struct OverlapOptions {
  JointAngles rest =
      {};  ///< the pose in which the meshes are known: checked, and where contacts are left out
  ContactAtRest contact_at_rest = ContactAtRest::refuse;
  /// Triangles with all three corners in this region are left out: of the fixed body as it is, and of the
  /// mobile body where the region is a ball without a cone (it is then the same in every pose). Every contact
  /// on such a triangle is in the region; contacts on those across its border still count.
  std::optional<ArticularRegion> leave_out_region = {};
  std::optional<LeaveOutRestContacts> leave_out_rest_contacts = {};

  bool leaves_out() const noexcept { return leave_out_region || leave_out_rest_contacts; }
};

/// How many triangles of each body are left out.
struct LeftOut {
  std::size_t fixed_triangles = 0, mobile_triangles = 0;
};

/// A mesh without some of its triangles: the same vertices, and the numbers of the triangles that stayed.
struct PartOfMesh {
  Mesh mesh;
  std::vector<Index> triangle_in_whole;

  std::size_t left_out(const Mesh& whole) const noexcept {
    return whole.triangles().size() - mesh.triangles().size();
  }
};

struct PartsOfJoint {
  PartOfMesh fixed, mobile;
};

/// Both bodies without what the options leave out. Throws UsageError for a radius that is not above 0, a
/// cone without an axis or fewer than 0 rings, and MeshError where nothing of a body is left.
PartsOfJoint parts_that_count(const Joint& joint, const OverlapOptions& options);

/// Bodies in contact at rest where the options say nothing about it.
class ContactAtRestError : public MeshError {
 public:
  using MeshError::MeshError;
};

/// One line for people whose meshes overlap: how much, where it is deepest, and what can be done.
std::string explain_overlap(const Joint& joint, const JointAngles& at);

}  // namespace condyle
