#pragma once

#include "condyle/io/recorded_motion.hpp"

namespace condyle::io {

/// Poses X_parent_child of every frame as the joint's functions have them, in mm: a coordinate is its column's value, or what a
/// coupler makes of others, or its default. Degrees are read for rotational coordinates only, as OpenSim does; lengths are
/// metres. Columns of speeds are none. Raises FileError for a model or a joint that cannot be read, a table with no column of
/// the joint's, and angles without a unit.
RecordedPoses model_poses(const MotionTable& table, const PosesOfModel& mapping);

}  // namespace condyle::io
