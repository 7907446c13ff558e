#include "io/joint/recorded_motion_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "condyle/error.hpp"
#include "condyle/make_joint.hpp"
#include "io/joint/mesh_path.hpp"
#include "io/joint/pose_matrix.hpp"

namespace condyle::io {
namespace {

std::string named_column(const TomlTable& table, std::string_view key, std::string name) {
  if (name.empty()) table.fail(key, "must name a column");
  return name;
}

ColumnUnit unit_of(TomlTable& table, CoordinateKind kind) {
  if (kind == CoordinateKind::angle)
    return table.required_word("unit", {"deg", "rad"}) == 0 ? ColumnUnit::degrees : ColumnUnit::radians;
  return table.required_word("unit", {"mm", "m"}) == 0 ? ColumnUnit::millimetres : ColumnUnit::metres;
}

/// flexion = "knee_flex_r", or flexion = { column = "knee_flex_r", unit = "rad", sign = -1, offset = 0.5 }.
ColumnOfCoordinate column_of(TomlTable& file, const CoordinateName& coordinate) {
  ColumnOfCoordinate out{.coordinate = coordinate.name, .kind = coordinate.kind};
  const bool is_length = coordinate.kind == CoordinateKind::length;
  if (file.is_text(coordinate.name)) {
    if (is_length)
      file.fail(coordinate.name,
                "a length needs its unit: write { column = \"...\", unit = \"mm\" } or \"m\"");
    out.column = named_column(file, coordinate.name, *file.text(coordinate.name));
    return out;
  }
  TomlTable table = *file.table(coordinate.name);
  out.column = named_column(table, "column", table.required("column", table.text("column")));
  if (is_length || table.has("unit")) out.unit = unit_of(table, coordinate.kind);
  out.sign = table.number("sign").value_or(1);
  if (out.sign != 1 && out.sign != -1) table.fail("sign", "must be 1 or -1");
  out.offset = table.number("offset").value_or(0);
  out.otherwise = table.number("default");
  out.range = table.pair("range");
  if (out.range && !(out.range->front() <= out.range->back()))
    table.fail("range", "must be [lowest, highest]");
  out.is_locked = table.flag("locked").value_or(false);
  if (out.is_locked && !out.otherwise) table.fail("locked", "needs default, where the coordinate is locked");
  table.finish();
  return out;
}

ColumnsOfPoses columns_of_poses(TomlTable& table) {
  ColumnsOfPoses out;
  out.fixed_body = table.required("fixed_body", table.text("fixed_body"));
  out.mobile_body = table.required("mobile_body", table.text("mobile_body"));
  if (out.fixed_body == out.mobile_body) table.fail("mobile_body", "must be another body than fixed_body");
  out.unit = all_length_units[table.required_word("units", {"mm", "cm", "in", "m"})];
  table.finish();
  return out;
}

PosesOfModel poses_of_model(TomlTable& table, const std::filesystem::path& folder) {
  PosesOfModel out;
  out.model = folder / mesh_path(table, "model", table.required("model", table.text("model")));
  out.joint = table.required("joint", table.text("joint"));
  if (const auto unit = table.word("angles", {"deg", "rad"})) out.in_degrees = *unit == 0;
  table.finish();
  return out;
}

Pose pose_of(TomlTable& table, std::string_view key, double mm) {
  const auto rows = table.sixteen(key);
  if (!rows) return Pose::Identity();
  try {
    Pose X = io::pose_of_rows(*rows).X;
    X.translation() *= mm;
    return X;
  } catch (const UsageError& error) {
    table.fail(key, error.what());
  }
}

}  // namespace

ZeroOfColumns zero_of_columns(TomlTable table, double mm) {
  const std::size_t joint = table.required_word("joint", {"hip", "knee", "ankle", "elbow", "shoulder"});
  const Side side = table.required_word("side", {"right", "left"}) == 0 ? Side::right : Side::left;
  const auto point = [&](std::string_view key) { return table.required(key, table.triple(key)); };
  const Vec3 centre = mm * point("centre"), anterior = point("anterior"), superior = point("superior");
  ZeroOfColumns zero{.system = {all_anatomies[joint], side}};
  try {
    zero.X_PZ = frame_from_axes(centre, anterior, superior);
  } catch (const UsageError& error) {
    table.fail("anterior", error.what());
  }
  zero.X_PC = pose_of(table, "pose", mm);
  zero.X_AP = pose_of(table, "fixed", mm), zero.X_BC = pose_of(table, "mobile", mm);
  table.finish();
  return zero;
}

RecordedMotionMapping recorded_motion_mapping(TomlTable& table, std::span<const CoordinateName> coordinates,
                                              const std::filesystem::path& folder) {
  if (table.has("model") || table.has("joint")) {
    for (const CoordinateName& coordinate : coordinates)
      if (table.has(coordinate.name))
        table.fail(coordinate.name, "the model gives the poses already: leave one of the two out");
    return poses_of_model(table, folder);
  }
  if (table.has("fixed_body") || table.has("mobile_body") || table.has("units")) {
    for (const CoordinateName& coordinate : coordinates)
      if (table.has(coordinate.name))
        table.fail(coordinate.name,
                   "fixed_body and mobile_body give the poses already: leave one of the two out");
    return columns_of_poses(table);
  }
  std::vector<ColumnOfCoordinate> mapping;
  std::vector<std::string> names;
  for (const CoordinateName& coordinate : coordinates) {
    names.push_back(coordinate.name);
    if (table.has(coordinate.name))
      mapping.push_back(column_of(table, coordinate));
    else
      table.text(coordinate.name);  // notes the key as one that is known here
  }
  table.finish();
  if (mapping.empty())
    table.fail("fixed_body", fmt::format("is missing, and so are columns of {}", fmt::join(names, ", ")));
  return mapping;
}

}  // namespace condyle::io
