#pragma once

#include "condyle/articular_centre.hpp"
#include "condyle/articular_region.hpp"
#include "contact/joint_contact.hpp"

namespace condyle::motion {

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
/// Throws MeshError where the fixed mesh is open or too few vertices face a socket to determine a direction.
CentreShift even_joint_space(const JointContact& joint, const ArticularRegion& region, const Pose& X_FM,
                             const CentreRule& rule = {});

}  // namespace condyle::motion
