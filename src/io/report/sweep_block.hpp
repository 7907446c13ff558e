#pragma once

#include "io/report/block_arrays.hpp"
#include "io/sweep/sweep_result.hpp"

namespace condyle::io {

/// The sweep of a page: as sweep.json has it, but for what the page has of the joint, with the margin of each design, which target has
/// the least to spare there, and the safe intervals.
Json sweep_block(const SweepResult& sweep, BlockArrays& arrays);

}  // namespace condyle::io
