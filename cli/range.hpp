#pragma once

#include <vector>

#include "condyle/answer.hpp"
#include "condyle/io/joint_file.hpp"

/// The range of motion as commands request it.

namespace condyle::cli {

/// The built-in motions of a joint with those of its file.
std::vector<Motion> motions_of(const LoadedJoint& loaded);

/// answer_range() with its progress and its notes on standard error. Throws Interrupted on SIGINT or SIGTERM.
RangeAnswer answered_range(const LoadedJoint& loaded, const RangeRequest& request);

}  // namespace condyle::cli
