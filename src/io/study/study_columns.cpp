#include "io/study/study_columns.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "answer/records/limit_record.hpp"
#include "condyle/sample/hip.hpp"
#include "io/file/csv_fields.hpp"
#include "io/record/table_of.hpp"
#include "io/study/study_follow.hpp"
#include "io/study/study_load.hpp"
#include "io/study/study_measures.hpp"
#include "io/study/study_resection.hpp"
#include "io/study/study_table.hpp"

namespace condyle::io {
namespace {

using ColumnList = std::vector<ResultColumn>;

ColumnList id_columns() {
  return {{"id", "", text_column, "of the row of the table"},
          {"table_row", "", number_column, "number of the row, 1 for the first one"}};
}

ColumnList map_columns() {
  ColumnList columns = {{"map_points", "", number_column, "grid points of the map"},
                        {"map_free_volume_deg3", "deg^3", number_column, "of the free angles"},
                        {"map_free_volume_weighted_deg3", "deg^3", number_column,
                         "weighted by the invariant measure of rotations"}};
  for (const char* end : {"lower", "upper"})
    for (const char* reason :
         {"contact", "end_of_range", "contact_at_start", "ligament", "strained_at_start"})
      columns.push_back({fmt::format("map_{}_{}_points", end, reason), "", number_column,
                         fmt::format("points whose {} end has this reason", end)});
  columns.push_back(
      {"map_free_elsewhere_points", "", number_column, "in contact at the start, free at other angles"});
  columns.push_back({"map_island_points", "", number_column, "free again beyond contact"});
  return columns;
}

ColumnList depth_columns() {
  return {
      {"depth_in_contact", "", number_column, "1 where the bodies meet in the pose, else 0"},
      {"depth_mm", "mm", number_column, "of the deepest vertex of either body; empty where none is inside"},
      {"depth_kind", "", text_column, "along what it is a depth: radial, or the arc of this angle"},
      {"depth_volume_mm3", "mm^3", number_column,
       "of the space inside both; empty where a mesh is open or inside out"},
      {"depth_volume_error_mm3", "mm^3", number_column, "bound on what the volume is off by rounding"},
      {"depth_covered_again_mm3", "mm^3", number_column,
       "how much of that volume is counted again because a body covers it more than once"},
      {"depth_nearest_distance_mm", "mm", number_column,
       "smallest distance of the surfaces, 0 where they meet"},
      {"depth_state", "", text_column,
       "what contact in the pose is, as condyle depth says it: free, at_limit, bearing, impinging, strained, "
       "contact"},
      {"depth_to_limit_deg", "deg", number_column,
       "of one angle alone to the nearest limit; empty where no bone is met"}};
}

ColumnList hip_columns() {
  return {{"side", "", text_column, "right or left"},
          {"bearing_radius_mm", "mm", number_column,
           "radius of the sphere of the bearing surface; empty: none known"},
          {"bearing_margin_mm", "mm", number_column, "how far outside it contact is bearing contact"},
          {"notes", "", text_column,
           "codes of the notes on the joint, its load and its limits, with blanks between"},
          {"inputs_sha256", "", text_column,
           "of the row and of the contents of the files that were read for it"}};
}

void append(ColumnList& columns, const ColumnList& more) {
  columns.insert(columns.end(), more.begin(), more.end());
}

ColumnList following_columns() {
  return {{"exact", "", number_column,
           "1 where limits are exact; 0 where the centre is not held, and they are bounded"}};
}

/// Name, unit and meaning of what is carried.
ColumnList carried_columns(const StudyTable& table) {
  ColumnList columns;
  for (const auto& [column, name, is_number] : table.carried) {
    const sample::HipMeasure* measure = sample::hip_measure_named(table.columns[column]);
    columns.push_back({name, measure ? std::string(measure->unit) : "",
                       is_number ? number_column : text_column,
                       measure ? fmt::format("from the table: {}", measure->meaning) : "from the table"});
  }
  return columns;
}

ColumnList failure_columns() {
  return {{"exit_code", "", number_column, "of condyle rom for this joint"},
          {"message", "", text_column, "one line: file, element, what is wrong"},
          {"inputs_sha256", "", text_column,
           "of the row and of the contents of the files that were read for it"}};
}

}  // namespace

bool LimitColumns::operator()(const FieldColumn& column) const noexcept {
  return column.tables == Tables::studies || (column.tables == Tables::studies_with_bands && bands) ||
         (column.tables == Tables::studies_that_follow && follows);
}

LimitColumns limit_columns_of(const StudyTable& table, const StudyOptions& options) {
  return {options.bands.has_value(), may_follow(table, options)};
}

StudyColumns study_columns(const StudyTable& table, const StudyOptions& options) {
  const ColumnList carried = carried_columns(table);
  StudyColumns columns{id_columns(), id_columns(), id_columns()};
  for (ColumnList* each : {&columns.limits, &columns.hips, &columns.failures}) append(*each, carried);
  const LimitColumns of_limits = limit_columns_of(table, options);
  append(columns.limits, columns_of<LimitRecord>(options.anatomy, of_limits));
  if (options.resection) append(columns.limits, resected_limit_columns());
  append(columns.hips, hip_columns());
  if (of_limits.follows) append(columns.hips, following_columns());
  if (options.map) append(columns.hips, map_columns());
  if (options.depth_at) append(columns.hips, depth_columns());
  if (options.load) append(columns.hips, load_columns());
  if (options.measures) append(columns.hips, measure_columns(options.bands.has_value()));
  if (options.resection) append(columns.hips, resection_columns(*options.resection));
  append(columns.failures, failure_columns());
  return columns;
}

bool is_result_column(std::string_view name) {
  StudyOptions everything;
  everything.resection.emplace();
  for (const ColumnList& columns :
       {id_columns(), columns_of<LimitRecord>(Anatomy::hip, LimitColumns{.bands = true, .follows = true}),
        hip_columns(), following_columns(), map_columns(), depth_columns(), load_columns(),
        measure_columns(true), resected_limit_columns(), resection_columns(*everything.resection),
        failure_columns()})
    if (std::any_of(columns.begin(), columns.end(), [&](const auto& each) { return each.name == name; }))
      return true;
  return name.starts_with(resection_prefix);  // its other columns are named after motions
}

std::string header_of(const std::vector<ResultColumn>& columns) {
  std::vector<std::string> names;
  for (const ResultColumn& column : columns) names.push_back(csv_field(column.name));
  return csv_line(names);
}

std::string columns_csv(const StudyColumns& columns) {
  std::string lines = "table,column,unit,kind,meaning\n";
  const auto add = [&](const char* table, const ColumnList& of_table) {
    for (const auto& [name, unit, kind, meaning] : of_table)
      lines += csv_line(
          {table, csv_field(name), unit, kind == text_column ? "text" : "number", csv_field(meaning)});
  };
  add("limits", columns.limits);
  add("hips", columns.hips);
  add("failures", columns.failures);
  return lines;
}

StudyColumns read_columns_csv(std::string_view bytes, std::string_view name) {
  const Source source{bytes, name};
  TextCursor cursor(source);
  cursor.rest_of_line();
  StudyColumns columns;
  while (!cursor.at_end()) {
    const std::size_t line = cursor.line();
    const std::vector<std::string> fields = csv_fields(cursor.rest_of_line(), line, source);
    if (fields.size() != 5) source.fail(fmt::format("line {}: five fields are needed", line));
    ColumnList& table = fields[0] == "limits" ? columns.limits
                        : fields[0] == "hips" ? columns.hips
                                              : columns.failures;
    table.push_back({fields[1], fields[2], fields[3] == "text" ? text_column : number_column, fields[4]});
  }
  return columns;
}

}  // namespace condyle::io
