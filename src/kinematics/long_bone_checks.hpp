#pragma once

#include <optional>
#include <vector>

#include "condyle/joint_checks.hpp"

namespace condyle::kinematics {

/// Evidence of the shafts of long bones, and of the place where two bones are nearest, against a knee, ankle, elbow or shoulder.
///
///        |  |   shaft of the fixed body: up from the joint (not of a shoulder)
///        (  )
///        (  )   bones are nearest each other near the axis
///        |  |   shaft of the mobile body: down from the joint at zero angles (not of an ankle)
///
/// A shaft is what has its area spread along one line, at least twice as far as across it, and ends at the joint; a cartilage,
/// a patella or a stump of a bone says nothing there. Which of two bones is above the other, in the reference pose, needs no
/// shafts, only that they stand end to end. A free joint turns about no fixed point, and has that check only. A femur's condyles
/// (knee_checks.hpp) and its head say of a knee, of any kind, which way is up and which side it is of.
std::vector<JointNote> long_bone_notes(const Joint& joint, const JointPlacement& placement);

/// A hip that shows no socket: hip bone and whole femur both of the other side.
std::optional<JointNote> hip_side_note(const Joint& joint);

}  // namespace condyle::kinematics
