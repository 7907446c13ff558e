#pragma once

#include <span>

#include "condyle/io/recorded_motion.hpp"
#include "io/joint/coordinate_name.hpp"
#include "io/joint/toml_table.hpp"

namespace condyle::io {

/// The table [recorded_motion] of a joint file, whose keys are docs/motion-files.md: either columns of coordinates, of
/// those that the joint has, or columns of poses, or a model, whose file is found from the folder. Raises FileError with line and key.
RecordedMotionMapping recorded_motion_mapping(TomlTable& table, std::span<const CoordinateName> coordinates,
                                              const std::filesystem::path& folder);

/// Its table zero, lengths in units of `mm`: docs/motion-files.md.
ZeroOfColumns zero_of_columns(TomlTable table, double mm);

}  // namespace condyle::io
