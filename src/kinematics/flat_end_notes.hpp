#pragma once

#include <vector>

#include "condyle/joint_checks.hpp"

namespace condyle::kinematics {

/// That a bone of a hip ends in a plane near the joint: flat_ends_near_joint().
std::vector<JointNote> flat_end_notes(const Joint& joint);

}  // namespace condyle::kinematics
