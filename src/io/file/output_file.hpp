#pragma once

#include <filesystem>
#include <string_view>

namespace condyle::io {

/// Throws FileError where write_output_file() could not put a file there: to be called before long work. Leaves
/// nothing.
void check_output_file(const std::filesystem::path& path);

/// An answer that is one file: whole or not at all, in a folder that is made where it is missing. Throws FileError.
void write_output_file(const std::filesystem::path& path, std::string_view bytes);

}  // namespace condyle::io
