#pragma once

#include <optional>

#include "condyle/answer.hpp"

/// The range of motion of a joint whose translation follows a recorded motion or a load.

namespace condyle::answer {

/// Throws UsageError for motions that the record does not lead along, and for a load that balances nothing.
void check_follow(const RangeRequest& request);

/// answer_range() of a request that follows; empty if it was stopped.
std::optional<RangeAnswer> followed_range(const Joint& joint, const JointPlacement& placement,
                                          const RangeRequest& request, const AnswerControl& control);

}  // namespace condyle::answer
