#pragma once

#include <cstdint>

/// Motion files that were dropped on the page of a joint: read by the command line's own reader.

extern "C" {

struct CondyleJoint;

/// The frames of a motion file as the joint's poses, as JSON: `axis` (`time_s` or `frame`), `times`, `coordinates_deg`, `coordinates_mm` (three a
/// frame), `poses` (X_FM, 16 a frame), null in a gap, and `remarks`, lines of what was corrected or looks wrong. `columns` is the object
/// `recorded_motion` of the data block, or empty: then columns are named by the joint's coordinates. Null for a bad file, with the command line's
/// own line and the columns that there are in condyle_error().
const char* condyle_motion(CondyleJoint* joint, const char* name, const std::uint8_t* bytes, int count,
                           const char* columns);
}
