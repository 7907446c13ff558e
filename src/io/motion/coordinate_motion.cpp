#include "io/motion/coordinate_motion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "condyle/error.hpp"
#include "io/joint/coordinate_name.hpp"
#include "io/motion/column_names.hpp"
#include "io/motion/column_zero.hpp"

namespace condyle::io {

std::vector<ColumnOfCoordinate> columns_by_name(const MotionTable& table, const Joint& joint) {
  constexpr std::pair<const char*, ColumnUnit> angles[] = {{"_deg", ColumnUnit::degrees},
                                                           {"_rad", ColumnUnit::radians}};
  constexpr std::pair<const char*, ColumnUnit> lengths[] = {{"_mm", ColumnUnit::millimetres},
                                                            {"_m", ColumnUnit::metres}};
  std::vector<ColumnOfCoordinate> columns;
  std::string wanted;
  for (const CoordinateName& name : coordinate_names_of(joint.kind, joint.anatomy)) {
    for (const auto& [ending, unit] : name.kind == CoordinateKind::angle ? angles : lengths) {
      wanted += (wanted.empty() ? "" : ", ") + name.name + ending;
      if (std::find(table.columns.begin(), table.columns.end(), name.name + ending) != table.columns.end())
        columns.push_back(
            {.coordinate = name.name, .kind = name.kind, .column = name.name + ending, .unit = unit});
    }
  }
  if (columns.empty())
    throw FileError(fmt::format(
        "{}: no column says a coordinate of the joint ({}), and the joint file has no [recorded_motion]{}",
        table.path.string(), wanted, those_there(table.columns)));
  return columns;
}

bool is_of_curves(const MotionTable& table, const Joint& joint) {
  const auto has = [&](const std::string& name) {
    return std::find(table.columns.begin(), table.columns.end(), name) != table.columns.end();
  };
  const auto names = coordinate_names_of(joint.kind, joint.anatomy);
  return has("smallest_gap_mm") && std::all_of(names.begin(), names.end(), [&](const CoordinateName& name) {
           return has(name.name + (name.kind == CoordinateKind::angle ? "_deg" : "_mm"));
         });
}

void note_times(JointMotion& motion) {
  if (!motion.times.in_seconds) return;
  if (auto note = motion::check_times(motion.times.values)) motion.notes.push_back(std::move(*note));
}

JointMotion motion_of_coordinates(const Joint& joint, const MotionTable& table,
                                  const std::vector<ColumnOfCoordinate>& mapping, const ZeroOfColumns* zero) {
  NamedCoordinates recorded = recorded_coordinates(table, mapping);
  JointMotion motion{
      .times = std::move(recorded.times), .X_FM = {}, .processing = std::move(recorded.processing)};
  for (std::size_t i = 0; i < recorded.names.size(); ++i) {
    double largest = 0;
    for (const auto& frame : recorded.frames)
      if (frame) largest = std::max(largest, std::abs((*frame)[i]));
    const std::string& name = recorded.names[i];
    const bool is_length = name == "x" || name == "y" || name == "z";
    if (auto check = motion::check_recorded(
            name, is_length ? motion::RecordedKind::length_mm : motion::RecordedKind::angle_deg, largest))
      motion.notes.push_back(std::move(*check));
  }
  motion::add_new(motion.notes, std::move(recorded.notes));
  note_times(motion);
  std::string missing;
  for (const CoordinateName& name : coordinate_names_of(joint.kind, joint.anatomy))
    if (std::find(recorded.names.begin(), recorded.names.end(), name.name) == recorded.names.end())
      missing += (missing.empty() ? "" : ", ") + name.name;
  if (!missing.empty())
    motion.processing.push_back(fmt::format("{}: not recorded, held at 0: {}", table.path.string(), missing));
  for (const auto& frame : recorded.frames) {
    if (!frame) {
      motion.X_FM.emplace_back();
      continue;
    }
    motion.X_FM.emplace_back(pose_at(zero ? zero->system : joint.coordinates(),
                                     coordinates_by(mapping, *frame, joint.anatomy),
                                     zero ? zero->translation_frame : joint.translation_frame));
  }
  return motion;
}

}  // namespace condyle::io
