#pragma once

#include <optional>
#include <string>
#include <vector>

#include "condyle/make_joint.hpp"
#include "kinematics/hip_anatomy.hpp"
#include "page_joint.hpp"

/// Common parts of joints that the page proposes, of meshes and of bones of label maps.

/// 0 right, 1 left, below to be inferred.
std::optional<condyle::Side> given_side(int side);

/// Head, socket and their places. UsageError if no head was found near the fixed body.
condyle::kinematics::HipAnatomy hip_of(const condyle::TriMesh& fixed, const condyle::TriMesh& mobile);

/// Evidence for kind and centre, one line each.
std::vector<std::string> head_evidence(const condyle::kinematics::HipAnatomy& hip);

/// The ball joint of this side, unit and axes about the centre of the mobile body's head. Its checks are added to the proposal.
CondyleJoint* joint_of(condyle::JointDescription description, condyle::Body fixed, condyle::Body mobile,
                       PageProposal proposal);
