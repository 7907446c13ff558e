#pragma once

#include <optional>

#include "condyle/joint.hpp"
#include "condyle/joint_checks.hpp"

namespace condyle::kinematics {

/// The ellipsoid through a head: its axes over the shortest of them, ascending, and their directions, in columns.
struct HeadShape {
  Vec3 axes;
  Eigen::Matrix3d directions;
};

/// Fitted to vertices near the sphere that face outwards, 60 degrees and more from the neck's axis, again without those that are off it: of
/// cams up to an alpha angle of 80 degrees nothing is left. Empty where they are no ellipsoid's. Linear in the mesh.
std::optional<HeadShape> head_shape(const TriMesh& mesh, const Sphere& head);

/// Says of a human hip that its head is longer one way than across. The axes of two real heads differ by 3 and 7 %. They differ by 9.5 % and more
/// where slices lost a tenth of their spacing, and by 13 % and more where a gantry's tilt of 10 degrees shears them: a sphere fits such heads too, and limits
/// are off by tens of degrees.
std::optional<JointNote> head_shape_note(const Joint& joint, const Sphere& head);

}  // namespace condyle::kinematics
