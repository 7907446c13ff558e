#pragma once

#include <span>
#include <string>
#include <vector>

#include "condyle/io/recorded_motion.hpp"
#include "condyle/joint_coordinates.hpp"
#include "io/joint/toml_table.hpp"

namespace condyle::io {

/// A coordinate that a joint has, and so one that a table of it may name.
struct CoordinateName {
  std::string name;
  CoordinateKind kind = CoordinateKind::angle;
};

/// Names of a joint's coordinates: angles by their positive names, and for a free joint x, y and z.
std::vector<CoordinateName> coordinate_names_of(JointKind kind, Anatomy joint);

/// The table [recorded_motion] of a joint file, whose keys are docs/motion-files.md: either columns of coordinates, of
/// those that the joint has, or columns of poses, or a model, whose file is found from the folder. Raises FileError with line and key.
RecordedMotionMapping recorded_motion_mapping(TomlTable& table, std::span<const CoordinateName> coordinates,
                                              const std::filesystem::path& folder);

}  // namespace condyle::io
