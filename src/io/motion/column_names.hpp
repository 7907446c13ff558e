#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "condyle/io/recorded_motion.hpp"

namespace condyle::io {

/// The place of a column, by its name, by joint and coordinate ("knee_r/knee_flex_r": the coordinate by itself, or a path of
/// that joint) or by the coordinate of an OpenSim path ("knee_flex_r" of
/// "/jointset/knee_r/knee_flex_r/value"); nothing if there is none. Raises FileError where it could be two.
std::optional<std::size_t> find_column(const MotionTable& table, std::string_view name);
/// The same; raises FileError if there is none.
std::size_t column_named(const MotionTable& table, std::string_view name);

/// "; it has 'time', 'knee_flex_r' and 12 more", for messages about a column that is not there.
std::string those_there(const std::vector<std::string>& names);

}  // namespace condyle::io
