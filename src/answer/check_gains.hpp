#pragma once

#include "condyle/answer/resection.hpp"

namespace condyle {

/// Throws UsageError for a gain that leads beyond its motion's range, before longer work; of a joint without limits nothing.
void check_gains(const Case& of, const RangeRequest& range, const ResectionRequest& request);

}  // namespace condyle
