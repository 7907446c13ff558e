#pragma once

#include <vector>

#include "condyle/io/joint_file.hpp"

namespace condyle::io {

/// The columns that name coordinates of the joint and their units: flexion_deg, x_mm. FileError if there is none.
std::vector<ColumnOfCoordinate> columns_by_name(const MotionTable& table, const Joint& joint);

/// Whether the table is curves.csv of condyle motion for such a joint: it has every coordinate, and gaps between the bodies.
bool is_of_curves(const MotionTable& table, const Joint& joint);

/// Notes times in seconds that look like milliseconds.
void note_times(JointMotion& motion);

/// The motion of a joint whose coordinates these columns record; those without a column are held at 0, which is noted. With
/// a zero the poses are pose_at() in its system.
JointMotion motion_of_coordinates(const Joint& joint, const MotionTable& table,
                                  const std::vector<ColumnOfCoordinate>& mapping,
                                  const ZeroOfColumns* zero = nullptr);

}  // namespace condyle::io
