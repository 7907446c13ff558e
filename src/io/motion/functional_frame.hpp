#pragma once

#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include "condyle/io/joint_file.hpp"
#include "kinematics/functional_centre.hpp"

namespace condyle::io {

/// Where a joint turned by a recorded motion, in the frames of its bodies: a ball about a centre, others about an axis.
struct FunctionalFrame {
  std::filesystem::path path;
  std::variant<kinematics::FunctionalCentre, kinematics::FunctionalAxis> found;
  std::vector<std::string> processing;
};

/// From the poses of [recorded_motion], of both bodies' matrices or of a model; whatever the joint's kind is, they may translate. FileError
/// for columns of coordinates, which turn about the joint's own centre; MeshError, which names the table, as functional_centre() and
/// functional_axis().
FunctionalFrame functional_frame(const LoadedJoint& joint, const MotionTable& table);

}  // namespace condyle::io
