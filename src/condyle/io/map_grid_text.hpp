#pragma once

#include <string>
#include <string_view>

#include "condyle/motion/motion_map.hpp"

namespace condyle {

/// Reads the values of a held angle as people write them: "flexion=-20:120:1", first, last and step in
/// degrees. Throws UsageError on anything else, an unknown angle, an axis that ends before it begins, or a
/// step that is not above 0.
GridAxis parse_grid_axis(std::string_view text);

/// The axis as parse_grid_axis() reads it back, to the last bit.
std::string to_text(const GridAxis& axis);

}  // namespace condyle
