#pragma once

#include <string>
#include <string_view>

#include "condyle/motion_map.hpp"

namespace condyle::io {

/// Reads one axis of a map as people write it: "flexion=-20:120:1" is flexion from -20 to 120 degrees in
/// steps of 1; without a step, 1; "flexion=30" is that one value. Throws UsageError for unknown names and
/// anything that is not finite numbers in this form, with the joint's names; check_grid() checks whether the axis
/// makes sense.
motion::GridAxis parse_grid_axis(std::string_view text, Anatomy joint);

/// The axis as parse_grid_axis() reads it back: "flexion=-20:120:1".
std::string to_text(const motion::GridAxis& axis, Anatomy joint);

}  // namespace condyle::io
