#include "condyle/io/joint_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "condyle/error.hpp"
#include "condyle/io/pose_text.hpp"
#include "condyle/io/provenance.hpp"
#include "io/motion/column_names.hpp"
#include "io/motion/coordinate_motion.hpp"
#include "io/motion/model_poses.hpp"

namespace condyle::io {
namespace {

/// Where a mesh file's frame lies in the body's joint frame, its lengths in mm.
Pose joint_from_file(const MeshOrigin& origin, LengthUnit unit) {
  Pose X = Pose::Identity();
  X.linear() = origin.joint_from_source.linear() / mm_per(unit);
  X.translation() = origin.joint_from_source.translation();
  return X;
}

/// The motion from poses of the mobile body's own frame in the fixed body's.
JointMotion of_poses(const LoadedJoint& loaded, const MotionTable& table, RecordedPoses recorded) {
  JointMotion motion{.times = std::move(recorded.times),
                     .X_FM = {},
                     .processing = std::move(recorded.processing),
                     .notes = std::move(recorded.notes)};
  const Provenance from = provenance_of(loaded, {});
  const LengthUnit unit = loaded.report.file.joint.units;
  double farthest = 0;
  const Pose X_FA = joint_from_file(from.fixed, unit), X_BM = inverted(joint_from_file(from.mobile, unit));
  for (std::size_t i = 0; i < recorded.X_FM.size(); ++i) {
    if (!recorded.X_FM[i]) {
      motion.X_FM.emplace_back();
      continue;
    }
    const Pose X_FM = X_FA * *recorded.X_FM[i] * X_BM;
    constexpr double rounding = 1e-6;
    if (loaded.joint.kind != JointKind::free && X_FM.translation().norm() > rounding)
      throw FileError(fmt::format(
          "{}: line {}: the mobile body's centre is {:.3f} mm from the fixed body's, and a {} does not "
          "translate",
          table.path.string(), table.line_of_row[i], X_FM.translation().norm(), name_of(loaded.joint.kind)));
    motion.X_FM.emplace_back(X_FM);
    farthest = std::max(farthest, X_FM.translation().norm());
  }
  if (auto check = motion::check_recorded("the translation", motion::RecordedKind::length_mm, farthest))
    motion.notes.push_back(std::move(*check));
  note_times(motion);
  return motion;
}

/// Whether a mapping of coordinates names a column of the table, which then counts as it says.
bool names_a_column(const RecordedMotionMapping& mapping, const MotionTable& table) {
  const auto* columns = std::get_if<std::vector<ColumnOfCoordinate>>(&mapping);
  return columns && std::any_of(columns->begin(), columns->end(), [&](const ColumnOfCoordinate& entry) {
           return io::find_column(table, entry.column).has_value();
         });
}

}  // namespace

JointMotion motion_of(const LoadedJoint& joint, const MotionTable& table) {
  const auto& mapping = joint.report.file.recorded_motion;
  const bool is_again = mapping && io::is_of_curves(table, joint.joint) && !names_a_column(*mapping, table);
  const auto read = [&] {
    if (!mapping || is_again)
      return io::motion_of_coordinates(joint.joint, table, io::columns_by_name(table, joint.joint));
    if (const auto* poses = std::get_if<ColumnsOfPoses>(&*mapping))
      return of_poses(joint, table, recorded_poses(table, *poses));
    if (const auto* poses = std::get_if<PosesOfModel>(&*mapping))
      return of_poses(joint, table, io::model_poses(table, *poses));
    return io::motion_of_coordinates(joint.joint, table, std::get<std::vector<ColumnOfCoordinate>>(*mapping));
  };
  JointMotion motion = read();
  if (is_again)
    motion.processing.push_back(
        fmt::format("{}: is of condyle motion: its columns of coordinates are read, not [recorded_motion]",
                    table.path.string()));
  motion.path = table.path;
  motion.digest = table.digest;
  return motion;
}

std::vector<JointCoordinates> coordinates_of(const Joint& joint, const JointMotion& motion) {
  std::vector<JointCoordinates> coordinates;
  for (const std::optional<Pose>& X_FM : motion.X_FM)
    if (X_FM) coordinates.push_back(coordinates_at(joint.coordinates(), *X_FM, joint.translation_frame));
  return coordinates;
}

}  // namespace condyle::io
