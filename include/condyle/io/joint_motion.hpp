#pragma once

#include <optional>
#include <string>
#include <vector>

#include "condyle/contact_checks.hpp"
#include "condyle/io/joint_file.hpp"
#include "condyle/io/motion_file.hpp"
#include "condyle/io/recorded_motion.hpp"

/// A recorded motion of a joint: from the columns of a table to poses X_FM in the joint frame.

namespace condyle {

struct JointMotion {
  FrameTimes times;
  std::vector<std::optional<Pose>> X_FM;  ///< in the joint frame; empty for gaps
  std::vector<std::string> processing;    ///< of the table and of its reading
  std::filesystem::path path = {};        ///< of the table
  FileDigest digest = {};
  std::vector<ContactNote> notes = {};  ///< what looks wrong with its numbers: their unit
};

/// By the joint file's [recorded_motion]. Without one the table must have columns named after the joint's coordinates and
/// their units: flexion_deg, internal_rotation_rad, x_mm, z_m; coordinates without a column are 0, and a note says so.
/// Columns of poses are of the frames of the mesh files. FileError as for recorded_coordinates() and recorded_poses(), and
/// for a joint that does not translate if its poses do by more than 1e-6 mm.
JointMotion motion_of(const LoadedJoint& joint, const MotionTable& table);

}  // namespace condyle
