#pragma once

#include <optional>
#include <string>
#include <vector>

#include "kinematics/joint_cylinder.hpp"
#include "kinematics/shaft_line.hpp"
#include "kinematics/shown_axes.hpp"

namespace condyle::kinematics {

/// Anatomy of the elbow from a humerus, before any frame is known: the axis of trochlea and capitellum, and superior along the
/// shaft. Front is not inferred; the axis lies in front of the shaft's line in a straight humerus, which is given as evidence.
struct ElbowAnatomy {
  JointCylinder trochlea;
  Vec3 centre = Vec3::Zero();      ///< the middle of the trochlea's axis
  std::optional<ShaftLine> shaft;  ///< of the humerus
  std::optional<Vec3> superior;    ///< square to the axis
  std::string why_no_superior;
  std::optional<Vec3> from_shaft_line;  ///< unit, with superior: from the shaft's line to the axis
  double off_shaft_line_mm = 0;
};

/// Takes meshes in mm.
ElbowAnatomy elbow_anatomy(const TriMesh& humerus, const TriMesh& ulna);

}  // namespace condyle::kinematics
