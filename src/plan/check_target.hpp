#pragma once

#include "condyle/resection.hpp"

namespace condyle::plan {

/// Throws UsageError for a reach that is not within the motion's range, and a gain that is not above 0.
void check_target(const ReachTarget& target);

}  // namespace condyle::plan
