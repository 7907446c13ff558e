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

/// Of a hip whose head is longer one way than across: of two real femora the axes differ by 3 and 7 % (as label maps 8 %), of those whose slices lost a tenth of their
/// spacing by 10 to 17 %, of those that a gantry's tilt of 10 degrees shears by 16 to 21 %. A sphere fits each of them, and its limits are off by tens of degrees.
std::optional<JointNote> head_shape_note(const Joint& joint, const Sphere& head);

}  // namespace condyle::kinematics
