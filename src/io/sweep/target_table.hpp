#pragma once

#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

#include "condyle/joint_coordinates.hpp"
#include "condyle/sweep.hpp"

namespace condyle::io {

/// The targets of a sweep, a row each: docs/sweeps.md. `motions` are those that a row can name. Raises FileError that names line and column:
/// no header, a column that there is not or twice, a motion that nobody knows, a number that is none, a name given twice.
std::vector<plan::SweepTarget> read_targets(const std::filesystem::path& path,
                                            std::span<const motion::Motion> motions, JointKind kind,
                                            Anatomy joint);
/// The same of a text; `name` is what errors call it.
std::vector<plan::SweepTarget> parse_targets(std::string_view text, std::string_view name,
                                             std::span<const motion::Motion> motions, JointKind kind,
                                             Anatomy joint);

}  // namespace condyle::io
