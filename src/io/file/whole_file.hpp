#pragma once

#include <filesystem>
#include <string_view>

#include "io/file/input_file.hpp"

namespace condyle::io {

/// The file that a name leads to, the name itself if it is no link or leads to nothing. Raises FileError for a link
/// that cannot be resolved.
std::filesystem::path end_of_links(const std::filesystem::path& path);

/// Puts bytes under a name: whole, or not at all. They are written beside it under a temporary name, which
/// then takes the place of the file that had the name before, or that a link of this name leads to; on failure nothing is left
/// behind and the old file stays. A FIFO or a device that takes characters is written into, and nothing else is replaced.
/// Raises FileError.
void write_whole_file(const std::filesystem::path& path, std::string_view bytes);

}  // namespace condyle::io
