#include "kinematics/shoulder_checks.hpp"
#include "kinematics/cut_parts.hpp"

#include <optional>

#include "core/formatted.hpp"
#include "core/rounded.hpp"
#include "kinematics/hip_anatomy.hpp"
#include "kinematics/hip_parts.hpp"
#include "mesh/surface_pieces.hpp"

namespace condyle::kinematics {
namespace {

using core::formatted;

/// How near the joint centre the centre of a sphere must be to be taken for the head, mm: as for bearing surfaces.
constexpr double farthest_stray_sphere = 5;

/// A head glides in its glenoid by some millimetres; a quarter of its radius beside the glenoid's axis it is out of place.
constexpr double farthest_beside_axis = 0.25;

/// A scapula has its mass farther from its glenoid than this, in radii of the head; a mesh of a glenoid has not.
constexpr double least_lever = 1;

/// Cosine. A glenoid opens sideways and a scapula lies medial of it, both within 45 degrees.
constexpr double opposed_cosine = -0.3;

/// The sphere about the joint centre, from which bearing surfaces are inferred; if there is none, one anywhere.
std::optional<SphericalPatch> head_of(const Mesh& humerus) {
  const auto& near_centre = head_near_centre(humerus);
  if (near_centre && (near_centre->coverage >= least_humeral_coverage ||
                      near_centre->fit.sphere.centre.norm() <= farthest_stray_sphere))
    return near_centre;
  const auto& anywhere = head_anywhere(humerus);
  return anywhere && anywhere->coverage >= least_humeral_coverage ? anywhere : near_centre;
}

/// A head on the fixed body, and a glenoid before it on the mobile one.
bool are_swapped(const Joint& joint) {
  const auto& head = head_near_centre(joint.fixed.mesh);
  if (!head || head->coverage < least_humeral_coverage) return false;
  const auto socket = shallow_socket_around(joint.mobile.mesh, head->fit.sphere);
  return *socket && (*socket)->sphere && is_socket_of(head->fit.sphere, *(*socket)->sphere);
}

double distance_from_line(const Vec3& point, const Vec3& on_line, const Vec3& direction) {
  return (point - on_line).cross(direction).norm();
}

/// Notes on a head and the glenoid before it, whose axis goes from its middle to its centre.
void check_glenoid(const Joint& joint, const Sphere& head, const ShallowSocket& socket,
                   std::vector<JointNote>& notes) {
  const Vec3 axis = (socket.sphere->fit.sphere.centre - socket.middle).normalized();
  const double beside = distance_from_line(head.centre, socket.middle, axis);
  if (beside > farthest_beside_axis * head.radius)
    notes.push_back({JointNoteCode::head_socket_apart,
                     "the head of " + joint.mobile.name +
                         formatted(" has its centre %.1f mm beside the axis of its socket", beside)});
  const Vec3 mass = area_centroid(mesh::outer_surface(joint.fixed.mesh)) - socket.middle;
  if (mass.norm() < least_lever * head.radius) return;
  const bool is_right = joint.side == Side::right;
  const double lateral = (is_right ? 1 : -1) * (axis - mass.normalized()).z() / 2;
  if (lateral < opposed_cosine)
    notes.push_back(
        {JointNoteCode::wrong_side,
         std::string("the side is ") + (is_right ? "right" : "left") + ", but " + joint.fixed.name +
             " lies lateral of its socket: it is the other side's or mirrored, or the axes are turned"});
}

}  // namespace

std::vector<JointNote> shoulder_notes(const Joint& joint, const JointPlacement& placement) {
  std::vector<JointNote> notes;
  const std::string& mobile = joint.mobile.name;
  const auto head = head_of(joint.mobile.mesh);
  const bool is_head = head && head->coverage >= least_humeral_coverage;
  // Far from the joint centre even a scapula may have something round.
  if (!(is_head && head->fit.sphere.centre.norm() <= farthest_stray_sphere) && are_swapped(joint)) {
    // A reverse shoulder has its head on the scapula.
    if (!joint.implant)
      notes.push_back({JointNoteCode::swapped_bodies, joint.fixed.name + " has a head and " + mobile +
                                                          " has a socket for it: are the bodies exchanged?"});
    return notes;
  }
  if (!is_head) {
    if (head && !placement.sphere && head->fit.sphere.centre.norm() <= farthest_stray_sphere)
      notes.push_back(
          {JointNoteCode::low_coverage,
           formatted("the sphere about the joint centre is %.0f %% of one on ", 100 * head->coverage) +
               mobile + ": too little for a head, and bearing contact is inferred from it"});
    return notes;
  }
  const Sphere& sphere = head->fit.sphere;
  if (const double off = sphere.centre.norm(); off > by_head(farthest_from_head_mm, sphere))
    notes.push_back({JointNoteCode::centre_off_head,
                     formatted("the joint centre is %.1f mm from that of the head of ", off) + mobile +
                         formatted(", a sphere of radius %.1f mm about ", sphere.radius) +
                         core::rounded(sphere.centre, 1)});
  const auto socket = shallow_socket_around(uncut_surface(joint.fixed), sphere);
  if (*socket && (*socket)->sphere && is_socket_of(sphere, *(*socket)->sphere))
    check_glenoid(joint, sphere, **socket, notes);
  return notes;
}

}  // namespace condyle::kinematics
