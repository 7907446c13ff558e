#include "condyle/io/joint_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "condyle/error.hpp"
#include "condyle/io/pose_text.hpp"
#include "io/motion/column_names.hpp"
#include "io/motion/column_zero.hpp"
#include "io/motion/coordinate_motion.hpp"
#include "io/motion/model_poses.hpp"

namespace condyle::io {
namespace {

/// The motion from poses X_FM = X_left X X_right.
JointMotion of_poses(const LoadedJoint& loaded, const MotionTable& table, RecordedPoses recorded,
                     const Pose& X_left, const Pose& X_right) {
  JointMotion motion{.times = std::move(recorded.times),
                     .X_FM = {},
                     .processing = std::move(recorded.processing),
                     .notes = std::move(recorded.notes)};
  double farthest = 0;
  for (std::size_t i = 0; i < recorded.X_FM.size(); ++i) {
    if (!recorded.X_FM[i]) {
      motion.X_FM.emplace_back();
      continue;
    }
    const Pose X_FM = X_left * *recorded.X_FM[i] * X_right;
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

/// The motion from poses of the mobile body's own frame in the fixed body's.
JointMotion of_poses(const LoadedJoint& loaded, const MotionTable& table, RecordedPoses recorded) {
  const BodyFrames frames = body_frames(loaded);
  return of_poses(loaded, table, std::move(recorded), frames.X_FA, inverted(frames.X_MB));
}

/// The motion from columns, whose zero and axes may be others than the joint's.
JointMotion of_columns(const LoadedJoint& loaded, const MotionTable& table,
                       const std::vector<ColumnOfCoordinate>& columns) {
  const auto& zero = loaded.report.file.recorded_zero;
  if (!zero || !is_moved(*zero, loaded.joint)) return motion_of_coordinates(loaded.joint, table, columns);
  JointMotion by = motion_of_coordinates(loaded.joint, table, columns, &*zero);
  by.processing.push_back(
      fmt::format("{}: its columns have the zero, axes and side of [recorded_motion.zero], which are not "
                  "those of the joint: bodies are posed by them",
                  table.path.string()));
  JointMotion motion =
      of_poses(loaded, table, {std::move(by.times), std::move(by.X_FM), std::move(by.processing)}, zero->X_FZ,
               zero->X_YM);
  motion::add_new(motion.notes, std::move(by.notes));
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
    return of_columns(joint, table, std::get<std::vector<ColumnOfCoordinate>>(*mapping));
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
