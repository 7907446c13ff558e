#include "kinematics/loose_head.hpp"

#include "condyle/error.hpp"
#include "core/formatted.hpp"
#include "kinematics/cut_parts.hpp"
#include "kinematics/hip_anatomy.hpp"

namespace condyle::kinematics {
namespace {

/// In radii of the head: balls of 22 to 40 mm stand in bony sockets of 44 to 60.
constexpr double widest_bony_socket = 3;
/// Least share of a sphere that is a socket, and how far from its centre the head's may be, in the socket's radii.
constexpr double least_share = 0.2, farthest_aside = 0.5;

}  // namespace

std::optional<JointNote> loose_head_note(const Joint& joint, const Sphere& head) {
  try {
    const SphericalPatch socket = find_sphere(
        uncut_surface(joint.fixed), {.part = SphericalPart::socket,
                                     .smallest_radius = largest_socket_in_heads * head.radius,
                                     .largest_radius = widest_bony_socket * head.radius,
                                     .within = Sphere{head.centre, widest_bony_socket * head.radius}});
    const Sphere& sphere = socket.fit.sphere;
    if (socket.coverage < least_share ||
        (sphere.centre - head.centre).norm() > farthest_aside * sphere.radius)
      return std::nullopt;
    return JointNote{
        JointNoteCode::socket_larger_than_head,
        core::formatted("the head of radius %.1f mm stands in a socket of ", head.radius) + joint.fixed.name +
            core::formatted(" of radius %.1f mm: is it an implant's ball without its cup?", sphere.radius)};
  } catch (const MeshError&) {  // no socket at all
    return std::nullopt;
  }
}

}  // namespace condyle::kinematics
