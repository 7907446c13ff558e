#pragma once

#include <cstddef>
#include <string_view>

#include "condyle/io/recorded_motion.hpp"

namespace condyle::io {

/// The place of a column, by its name or by the coordinate of an OpenSim path ("knee_flex_r" of
/// "/jointset/knee_r/knee_flex_r/value"). Raises FileError if there is none, or where it could be two.
std::size_t column_named(const MotionTable& table, std::string_view name);

}  // namespace condyle::io
