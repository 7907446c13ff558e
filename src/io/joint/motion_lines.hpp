#pragma once

#include <span>

#include "condyle/range_of_motion.hpp"
#include "io/joint/proposal_lines.hpp"

namespace condyle::io {

/// [[motion]] tables of a joint file that is made from another one.
void add_motions(ProposalLines& lines, std::span<const motion::Motion> motions, Anatomy anatomy);

}  // namespace condyle::io
