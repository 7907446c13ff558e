#pragma once

#include <span>
#include <string>
#include <string_view>

#include "condyle/motion_map.hpp"

namespace condyle::io {

/// Reads one axis of a map as people write it: "flexion=-20:120:1" is flexion from -20 to 120 degrees in
/// steps of 1, "x=-1:1:0.5" a translation in mm; without a step, 1; "flexion=30" is that one value. Throws UsageError for unknown names
/// and anything that is not finite numbers in this form, with the joint's names; check_grid() checks whether the axis makes sense.
motion::GridAxis parse_grid_axis(std::string_view text, Anatomy joint);

/// The axis as parse_grid_axis() reads it back: "flexion=-20:120:1".
std::string to_text(const motion::GridAxis& axis, Anatomy joint);

/// The coordinate of this name: a joint angle, x, y or z. Throws UsageError with the joint's names.
motion::MapCoordinate map_coordinate_named(std::string_view name, Anatomy joint);

/// A grid of axes, columns first; one more axis of one value each holds another angle there. `vary` may be empty if the grid is of two angles:
/// it is the third then. Throws UsageError as parse_grid_axis() and for fewer than two axes.
motion::MapGrid parse_grid(std::span<const std::string> axes, std::string_view vary, Anatomy joint);

}  // namespace condyle::io
