#pragma once

#include <string>

#include "condyle/implant.hpp"
#include "io/joint/toml_table.hpp"

namespace condyle::io {

/// The table [implant] of a joint file, whose keys are in docs/implants.md; sizes left out have their defaults. Lengths are of the
/// file's unit. Throws FileError with line and key.
plan::Implant implant_entry(TomlTable& table, double mm_per_unit);

/// That table of a file in mm, with every size.
std::string implant_text(const plan::Implant& implant);

}  // namespace condyle::io
