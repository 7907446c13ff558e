#pragma once

#include <optional>
#include <string>
#include <vector>

#include "kinematics/joint_cylinder.hpp"
#include "kinematics/shaft_line.hpp"
#include "kinematics/shown_axes.hpp"

namespace condyle::kinematics {

/// Anatomy of the joint from a talus and a tibia, before any frame is known.
///
///      | shaft |  superior      The dome's cylinder gives the axis, the tibia's shaft superior; the talus reaches farther
///      |_     _|                forwards of its dome (neck and head) than backwards.
///      / `---' \ .-.
///     (    o    |   ) anterior  Medial and lateral are not inferred: a mesh of the tibia may have the fibula's malleolus too.
///      `-------' `-'
struct AnkleAnatomy {
  JointCylinder dome;
  Vec3 centre = Vec3::Zero();      ///< the middle of the dome's axis
  std::optional<ShaftLine> shaft;  ///< of the tibia
  std::optional<ShownAxes> axes;   ///< right along the dome's axis
  std::string why_no_axes;
  std::vector<std::string> evidence;
};

/// Takes meshes in mm.
AnkleAnatomy ankle_anatomy(const TriMesh& tibia, const TriMesh& talus);

}  // namespace condyle::kinematics
