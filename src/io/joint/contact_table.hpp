#pragma once

#include "condyle/io/joint_file.hpp"
#include "io/joint/toml_table.hpp"

namespace condyle::io {

/// The table [contact] of a joint file: `mm_per_unit` of its lengths, and the folder that paths start from. FileError with
/// line and key.
ContactEntry contact_entry(TomlTable& table, double mm_per_unit, const std::filesystem::path& folder);

}  // namespace condyle::io
