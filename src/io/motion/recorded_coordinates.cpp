#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <utility>

#include "condyle/error.hpp"
#include "condyle/io/recorded_motion.hpp"
#include "io/file/in_quotes.hpp"
#include "io/motion/column_names.hpp"
#include "io/motion/coordinate_limits.hpp"
#include "io/motion/gaps.hpp"

namespace condyle::io {
namespace {

ColumnUnit unit_of(const MotionTable& table, const ColumnOfCoordinate& entry) {
  if (entry.unit) {
    const bool is_degrees = entry.unit == ColumnUnit::degrees;
    // Nothing shows which of the two is wrong, and either answer would look right.
    if (entry.kind == CoordinateKind::angle && table.in_degrees && *table.in_degrees != is_degrees)
      throw FileError(
          fmt::format("{}: column {}: its unit is given as {}, and the header says inDegrees={}: leave the "
                      "unit out, or correct the header",
                      table.path.string(), io::in_quotes(entry.column), is_degrees ? "degrees" : "radians",
                      *table.in_degrees ? "yes" : "no"));
    return *entry.unit;
  }
  assert(entry.kind == CoordinateKind::angle && "a length has a unit");
  if (!table.in_degrees)
    throw FileError(
        fmt::format("{}: column {}: the file does not say whether angles are in degrees: give its unit",
                    table.path.string(), io::in_quotes(entry.column)));
  return *table.in_degrees ? ColumnUnit::degrees : ColumnUnit::radians;
}

/// To degrees or mm. An angle in degrees and a length in mm keep every bit.
double converted(double value, ColumnUnit unit) {
  switch (unit) {
    case ColumnUnit::radians:
      return value * (180 / std::numbers::pi);
    case ColumnUnit::metres:
      return value * 1000;
    default:
      return value;
  }
}

/// Whether a table has none of the columns, all of which have something to stand in for them.
bool has_none(const MotionTable& table, const std::vector<ColumnOfCoordinate>& mapping) {
  return std::none_of(mapping.begin(), mapping.end(), [&](const ColumnOfCoordinate& entry) {
    return !entry.otherwise || io::find_column(table, entry.column);
  });
}

CoordinateLimits coordinate_limits_of(const ColumnOfCoordinate& entry) {
  return {entry.column, entry.kind, entry.range, entry.is_locked ? entry.otherwise : std::nullopt};
}

}  // namespace

std::string_view name_of(ColumnUnit unit) noexcept {
  constexpr std::string_view names[] = {"deg", "rad", "mm", "m"};
  return names[static_cast<std::size_t>(unit)];
}

NamedCoordinates recorded_coordinates(const MotionTable& table,
                                      const std::vector<ColumnOfCoordinate>& mapping) {
  NamedCoordinates out;
  out.times = frame_times(table);
  out.processing = table.processing;
  out.frames.assign(table.rows, std::vector<double>());
  if (!mapping.empty() && has_none(table, mapping))
    throw FileError(fmt::format("{}: has none of the joint's columns, {} and the others{}",
                                table.path.string(), io::in_quotes(mapping.front().column),
                                those_there(table.columns)));
  BeyondLimits beyond;
  std::vector<std::vector<double>> degrees_by_header;
  for (const ColumnOfCoordinate& entry : mapping) {
    out.names.push_back(entry.coordinate);
    if (entry.otherwise && !io::find_column(table, entry.column)) {
      const bool is_angle = entry.kind == CoordinateKind::angle;
      out.processing.push_back(fmt::format("{}: has no column {}: {} {} stands in for it",
                                           table.path.string(), io::in_quotes(entry.column), *entry.otherwise,
                                           is_angle ? "degrees" : "mm"));
      for (auto& frame : out.frames)
        if (frame) frame->push_back(entry.sign * *entry.otherwise + entry.offset);
      beyond.check(coordinate_limits_of(entry), std::vector<double>(table.rows, *entry.otherwise));
      continue;
    }
    std::vector<double> column = table.values[io::column_named(table, entry.column)];
    const ColumnUnit unit = unit_of(table, entry);
    for (double& value : column) value = converted(value, unit);
    beyond.check(coordinate_limits_of(entry), column);
    if (!entry.unit && unit == ColumnUnit::degrees) degrees_by_header.push_back(column);
    for (std::size_t row = 0; row < table.rows; ++row) {
      auto& frame = out.frames[row];
      if (!frame) continue;
      if (std::isnan(column[row]))
        frame.reset();
      else
        frame->push_back(entry.sign * column[row] + entry.offset);
    }
  }
  out.notes = beyond.notes();
  if (auto note = motion::check_degrees(degrees_by_header)) out.notes.push_back(std::move(*note));
  io::note_gaps(table, out.frames, out.processing);
  return out;
}

}  // namespace condyle::io
