#pragma once

#include "condyle/articular_region.hpp"
#include "contact/joint_contact.hpp"

namespace condyle {

struct CentreRule {
  /// No larger shift is made: the centre of a hip moves by a millimetre or two against its socket.
  double largest_shift_mm = 3;
  /// Wider than any joint space: a ray that first meets the socket further off sees the rim or beyond.
  double largest_gap_mm = 6;
};

/// A small translation of the mobile body at one pose.
struct CentreShift {
  Vec3 translation = Vec3::Zero();  ///< of M in F, mm
  double gap_mm = 0;            ///< g: between the narrowest and the middle width of the evened joint space
  double spread_before_mm = 0;  ///< of the joint space about its middle, robust deviation, before
  double spread_after_mm = 0;   ///< and after
  std::size_t vertices = 0;     ///< of the head, that face the socket
  bool cut_back = false;        ///< the even joint space would ask for more than largest_shift_mm
};

/// The translation that evens the joint space: a head in a socket glides, it does not turn about a point
/// fixed in the pelvis, and on segmented bones head and socket have centres a millimetre apart.
///
/// With u_i the ray to a head vertex and g_i its radial gap, moving M by t changes the gap by -u_i . t to
/// first order (exactly so between concentric spheres), so t and the mean gap g minimise
///
///     sum_i loss(g_i - u_i . t - g),
///
/// solved anew from the moved pose until t settles. The fossa in the socket's floor is no joint surface and
/// lies millimetres deeper, over a quarter of the socket: plain least squares would sink the head into it.
/// The loss is Huber's with its knee at 0.3 mm, and a third of it for gaps that are too wide: what is far off
/// hardly pulls. It is convex, so that there is one answer and it changes gradually with the pose. Negative
/// gaps (overlap) count like others. Vertices count once each, so a finer patch weighs more. Head vertices
/// are those within the region's radius (in M).
///
/// Throws MeshError where the fixed mesh is open or too few vertices face a socket to tell a direction.
CentreShift even_joint_space(const JointContact& joint, const ArticularRegion& region, const Pose& X_FM,
                             const CentreRule& rule = {});

}  // namespace condyle
