#pragma once

#include "io/joint/proposal.hpp"

namespace condyle::io {

/// The joint file of a knee, ankle, shoulder or elbow, from what its bones show: docs/other-joints.md.
JointProposal proposal_of_other(ProposedBody fixed, ProposedBody mobile, Anatomy anatomy,
                                const ProposalFacts& facts);

}  // namespace condyle::io
