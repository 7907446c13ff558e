#pragma once

#include <filesystem>
#include <string_view>

#include "condyle/io/recorded_motion.hpp"

namespace condyle::io {

/// Whether a file of this name is one of OpenSim's tables, by its extension; FileError for one that is no table.
bool is_of_opensim(const std::filesystem::path& path);

/// The table of a file's bytes, as read_motion_table() reads it; `path` gives the format and names the file in messages.
MotionTable motion_table_of(std::string_view bytes, const std::filesystem::path& path);

}  // namespace condyle::io
