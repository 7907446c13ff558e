#pragma once

#include <optional>
#include <vector>

#include "condyle/io/joint_file.hpp"
#include "condyle/pressure.hpp"

/// Loads of a recorded motion, from a table of its own.

namespace condyle::io {

/// The load of every frame, from the columns force_x_n, force_y_n, force_z_n and, with free rotations, moment_x_nmm,
/// moment_y_nmm, moment_z_nmm, which may all be left out; nothing if one of them has a gap. FileError if rows are not at
/// the times of the motion, a column is missing, or moments are given that nothing balances.
std::vector<std::optional<contact::Load>> loads_of(const MotionTable& table, const FrameTimes& times,
                                                   BodyRole frame, bool free_rotations);

}  // namespace condyle::io
