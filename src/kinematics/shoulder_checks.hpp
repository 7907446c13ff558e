#pragma once

#include <vector>

#include "condyle/joint_checks.hpp"

namespace condyle::kinematics {

/// Least share of a sphere of a humeral head, whose cartilage covers a third of one; femoral heads have twice as much.
inline constexpr double least_humeral_coverage = 0.25;

/// Contradictions to a shoulder: bodies exchanged, little of a head, a centre beside it, a head beside its glenoid, a scapula
/// lateral of it. Searches both bodies for spheres, which are kept with their meshes.
std::vector<JointNote> shoulder_notes(const Joint& joint, const JointPlacement& placement);

}  // namespace condyle::kinematics
