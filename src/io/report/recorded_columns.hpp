#pragma once

#include <vector>

#include "condyle/io/recorded_motion.hpp"
#include "io/result/json.hpp"

namespace condyle::io {

/// The table [recorded_motion] of the joint file, for a page that reads motion files itself: `by` is columns, poses or model, and
/// `columns` lists those of coordinates.
Json recorded_motion_json(const RecordedMotionMapping& mapping);

/// The columns of such an object; it must be `by` columns.
std::vector<ColumnOfCoordinate> columns_of_json(const Json& json);

}  // namespace condyle::io
