#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace condyle::io {

/// "there is no file PATH", on one line; empty if there is something of that name.
std::string why_no_file(const std::filesystem::path& path);

/// Raises FileError for a file that is missing, a folder, or something else that is not a regular file.
void check_is_file(const std::filesystem::path& path);

/// The bytes of a regular file. Raises FileError for a file that is missing, a folder, or cannot be read.
std::string read_whole_file(const std::filesystem::path& path);

/// The file that a name leads to, the name itself if it is no link or leads to nothing. Raises FileError for a link
/// that cannot be resolved.
std::filesystem::path end_of_links(const std::filesystem::path& path);

/// Puts bytes under a name: whole, or not at all. They are written beside it under a temporary name, which
/// then takes the place of the file that had the name before, or that a link of this name leads to; on failure nothing is left
/// behind and the old file stays. A FIFO or a device that takes characters is written into, and nothing else is replaced.
/// Raises FileError.
void write_whole_file(const std::filesystem::path& path, std::string_view bytes);

}  // namespace condyle::io
