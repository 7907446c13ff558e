#pragma once

#include <filesystem>
#include <string_view>

#include "io/joint/toml_table.hpp"

namespace condyle::io {

/// A path that a key gives, ${NAME} replaced by the environment variable of that name. FileError with line and key where
/// that is not set, or nothing is left.
std::filesystem::path mesh_path(const TomlTable& table, std::string_view key, std::string_view text);

}  // namespace condyle::io
