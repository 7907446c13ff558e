#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace condyle::io {

/// Raises FileError for a file that is missing, a folder, or something else that is not a regular file.
void check_is_file(const std::filesystem::path& path);

/// The bytes of a regular file. Raises FileError for a file that is missing, a folder, or cannot be read.
std::string read_whole_file(const std::filesystem::path& path);

/// Puts bytes under a name: whole, or not at all. They are written beside it under a temporary name, which
/// then takes the place of whatever had the name before; on failure nothing is left behind and the old file
/// stays. Raises FileError.
void write_whole_file(const std::filesystem::path& path, std::string_view bytes);

}  // namespace condyle::io
