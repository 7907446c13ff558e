#pragma once

#include <optional>

#include "condyle/fit.hpp"

namespace condyle::kinematics {

/// A femur's own axes in the frame of its mesh, as columns: X forwards, Y from the middle of the condyles to the head's centre, Z to the right at a
/// right angle to Y, along the line behind both condyles. The axes of the frame must be less than 60 degrees from them. Empty if the mesh
/// has no head about the origin, or ends above condyles. Kept with the mesh.
const std::optional<Eigen::Matrix3d>& femoral_axes(const Mesh& femur);

}  // namespace condyle::kinematics
