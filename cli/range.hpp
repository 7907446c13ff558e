#pragma once

#include <string_view>

#include "condyle/answer.hpp"
#include "condyle/io/joint_file.hpp"

/// The range of motion as commands request it.

namespace condyle::cli {

/// answer_range() with its progress and its notes on standard error, each after `whose` joint it is of if a command has two. Throws
/// Interrupted on SIGINT or SIGTERM.
RangeAnswer answered_range(const io::LoadedJoint& loaded, const RangeRequest& request,
                           std::string_view whose = {});

}  // namespace condyle::cli
