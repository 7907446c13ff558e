#pragma once

#include <optional>
#include <string>

#include "condyle/joint.hpp"

namespace condyle::kinematics {

/// What of a straight piece of a ligament lies inside a body, and how far from its surface at most.
struct RunThrough {
  BodyRole body = BodyRole::fixed;
  double length_mm = 0, depth_mm = 0;
};

/// "runs through femur for 31 mm, up to 12 mm deep"
std::string text_of(const RunThrough& run, const Joint& joint);

/// The deepest run, if it is deeper than those of sound ligaments. Where one lies on its wrap it runs through nothing; nor does one whose length is not
/// known. Linear in the meshes.
std::optional<RunThrough> run_through(const Joint& joint, const Ligament& ligament, const Pose& X_FM);

}  // namespace condyle::kinematics
