#pragma once

#include <optional>

#include "condyle/answer/range.hpp"

/// The range of motion of a joint whose translation follows a recorded motion or a load.

namespace condyle::answer {

/// Throws UsageError for motions that the record does not lead along, and for a load that balances nothing.
void check_follow(const RangeRequest& request);

/// answer_range() of a request that follows; empty if it was stopped.
std::optional<RangeAnswer> followed_range(const Case& of, const RangeRequest& request,
                                          const Control& control);

}  // namespace condyle::answer
