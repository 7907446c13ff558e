#include "io/sweep/target_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include "condyle/error.hpp"
#include "condyle/io/pose_text.hpp"
#include "io/file/csv_fields.hpp"
#include "io/file/in_quotes.hpp"
#include "io/file/whole_file.hpp"
#include "io/file/words.hpp"
#include "io/result/map_result.hpp"

namespace condyle::io {
namespace {

constexpr std::string_view target_columns[] = {
    "name", "motion", "start", "movement", "reach_deg", "range_deg", "pelvic_tilt_deg", "weight", "source"};

/// Default range of a motion with its own start.
constexpr double usual_range_deg = 120;

/// One row, field by field.
class TargetRow {
 public:
  TargetRow(const std::vector<std::string>& columns, std::vector<std::string> fields, std::size_t line,
            const Source& source)
      : columns_(columns), fields_(std::move(fields)), line_(line), source_(source) {
    if (fields_.size() != columns.size())
      source.fail(
          fmt::format("line {}: has {} fields, and the header {}", line, fields_.size(), columns.size()));
  }

  std::string_view text(std::string_view column) const {
    const auto at = std::find(columns_.begin(), columns_.end(), column);
    return at == columns_.end() ? std::string_view()
                                : std::string_view(fields_[static_cast<std::size_t>(at - columns_.begin())]);
  }

  std::optional<double> number(std::string_view column) const {
    const std::string_view field = text(column);
    if (field.empty()) return std::nullopt;
    double value = 0;
    if (!parse_number(field, value) || !std::isfinite(value))
      fail(column, in_quotes(field) + " is no number");
    return value;
  }

  [[noreturn]] void fail(std::string_view column, std::string_view what) const {
    source_.fail(fmt::format("line {}: {}: {}", line_, column, what));
  }

 private:
  const std::vector<std::string>& columns_;
  std::vector<std::string> fields_;
  std::size_t line_;
  const Source& source_;
};

struct Movement {
  JointAngle angle;
  RotationSense sense;
};

Movement movement_of(const TargetRow& row, Anatomy joint) {
  std::string names;
  for (const JointAngle angle : all_joint_angles)
    for (const RotationSense sense : {RotationSense::positive, RotationSense::negative}) {
      const std::string_view name = movement_name(angle, sense, joint);
      if (row.text("movement") == name) return {angle, sense};
      names += (names.empty() ? "" : ", ") + std::string(name);
    }
  row.fail("movement", row.text("movement").empty()
                           ? "must say which angle grows from the start: " + names
                           : in_quotes(row.text("movement")) + " is none; there are " + names);
}

motion::Motion motion_of(const TargetRow& row, std::span<const motion::Motion> motions, JointKind kind,
                         Anatomy joint) {
  const bool is_named = !row.text("motion").empty();
  if (is_named) {
    for (const std::string_view other : {"start", "movement", "range_deg"})
      if (!row.text(other).empty()) row.fail(other, "the motion that is named has its own");
    try {
      return motion::motion_named(motions, row.text("motion"));
    } catch (const UsageError& error) {
      row.fail("motion", error.what());
    }
  }
  if (row.text("start").empty() && row.text("movement").empty())
    row.fail("motion", "must name a motion, or start and movement say one");
  const Movement movement = movement_of(row, joint);
  motion::Motion motion{std::string(row.text("name")), movement.angle, movement.sense};
  if (!row.text("start").empty()) {
    try {
      motion.start = parse_pose(row.text("start"), kind, joint).coordinates().angles;
    } catch (const UsageError& error) {
      row.fail("start", error.what());
    }
  }
  const double reach = row.number("reach_deg").value_or(0);
  motion.range = Angle::degrees(row.number("range_deg").value_or(std::max(usual_range_deg, reach)));
  return motion;
}

plan::SweepTarget target_of(const TargetRow& row, std::span<const motion::Motion> motions, JointKind kind,
                            Anatomy joint) {
  plan::SweepTarget target{std::string(row.text("name"))};
  if (target.name.empty()) row.fail("name", "is empty");
  target.motion = motion_of(row, motions, kind, joint);
  const auto reach = row.number("reach_deg");
  if (!reach) row.fail("reach_deg", "must say how far the motion has to turn");
  target.reach = Angle::degrees(*reach);
  if (!(target.reach > Angle()) || !(target.reach <= target.motion.range))
    row.fail("reach_deg", fmt::format("{} must be above 0 and up to the motion's range, {:.10g}", *reach,
                                      target.motion.range.degrees()));
  target.pelvic_tilt = Angle::degrees(row.number("pelvic_tilt_deg").value_or(0));
  target.weight = row.number("weight").value_or(1);
  if (!(target.weight > 0)) row.fail("weight", fmt::format("{:.10g} must be above 0", target.weight));
  target.source = row.text("source");
  return target;
}

void check_header(const std::vector<std::string>& columns, std::size_t line, const Source& source) {
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (std::find(std::begin(target_columns), std::end(target_columns), columns[i]) ==
        std::end(target_columns))
      source.fail(fmt::format("line {}: there is no column {}; there are {}", line, in_quotes(columns[i]),
                              fmt::join(target_columns, ", ")));
    if (std::find(columns.begin(), columns.begin() + static_cast<std::ptrdiff_t>(i), columns[i]) !=
        columns.begin() + static_cast<std::ptrdiff_t>(i))
      source.fail(fmt::format("line {}: column {} is there twice", line, in_quotes(columns[i])));
  }
  for (const std::string_view needed : {"name", "reach_deg"})
    if (std::find(columns.begin(), columns.end(), needed) == columns.end())
      source.fail(fmt::format("line {}: there is no column {}", line, needed));
}

}  // namespace

std::vector<plan::SweepTarget> parse_targets(std::string_view text, std::string_view name,
                                             std::span<const motion::Motion> motions, JointKind kind,
                                             Anatomy joint) {
  const Source source{text, name};
  TextCursor cursor(source);
  std::vector<std::string> columns;
  std::vector<plan::SweepTarget> targets;
  std::set<std::string> names;
  while (!cursor.at_end()) {
    const std::size_t line = cursor.line();
    const std::string_view row = cursor.rest_of_line();
    if (trimmed(row).empty() || trimmed(row).starts_with('#')) continue;
    std::vector<std::string> fields = csv_fields(row, line, source);
    if (columns.empty()) {
      columns = std::move(fields);
      check_header(columns, line, source);
      continue;
    }
    targets.push_back(target_of({columns, std::move(fields), line, source}, motions, kind, joint));
    if (!names.insert(targets.back().name).second)
      source.fail(fmt::format("line {}: name: {} is given twice", line, in_quotes(targets.back().name)));
  }
  if (targets.empty()) source.fail(columns.empty() ? "has no names of columns" : "has no target");
  return targets;
}

std::vector<plan::SweepTarget> read_targets(const std::filesystem::path& path,
                                            std::span<const motion::Motion> motions, JointKind kind,
                                            Anatomy joint) {
  return parse_targets(read_whole_file(path), path.string(), motions, kind, joint);
}

}  // namespace condyle::io
