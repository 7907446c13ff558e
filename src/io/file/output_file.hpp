#pragma once

#include <filesystem>
#include <span>
#include <string_view>

namespace condyle::io {

/// Throws FileError if write_output_file() could not put a file there, or where it would take the place of one of those
/// that were `read`: to be called before long work. Leaves nothing.
void check_output_file(const std::filesystem::path& path, std::span<const std::filesystem::path> read = {});

/// An answer that is one file: whole or not at all, in a folder that is made where it is missing. Where the name is a link, what it
/// leads to is replaced; a FIFO or a device that takes characters is written into. Throws FileError.
void write_output_file(const std::filesystem::path& path, std::string_view bytes);

}  // namespace condyle::io
