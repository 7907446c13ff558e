#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace condyle::io {

/// What a file is that was given as a joint file and is none, and which command takes it: "is a mesh, not a joint file: condyle init ...".
/// By its first bytes and its name; empty if they show nothing. FileError for an image that no reader reads.
std::string other_file(std::string_view bytes, const std::filesystem::path& path);

}  // namespace condyle::io
