#include "io/study/study_table.hpp"
#include "io/file/words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <initializer_list>
#include <map>
#include <set>

#include "condyle/sample/hip.hpp"
#include "core/lower_case.hpp"
#include "core/near_name.hpp"
#include "io/file/csv_fields.hpp"
#include "io/file/in_quotes.hpp"
#include "io/file/plain_text.hpp"
#include "io/file/whole_file.hpp"
#include "io/motion/table_builder.hpp"
#include "io/study/study_columns.hpp"

namespace condyle::io {
namespace {

/// Columns that give the source of a joint; not carried.
constexpr std::string_view source_columns[] = {
    "id",     "joint",       "fixed",        "mobile", "side",          "units",         "axes",  "sample",
    "labels", "fixed_label", "mobile_label", "task",   "opensim_model", "opensim_joint", "follow"};

bool is_source(std::string_view name) {
  return std::find(std::begin(source_columns), std::end(source_columns), name) != std::end(source_columns);
}

/// The columns that describe a joint in this table, and those that it lacks.
std::vector<std::string> missing_columns(const StudyTable& table) {
  const auto has = [&](std::string_view name) {
    return std::find(table.columns.begin(), table.columns.end(), name) != table.columns.end();
  };
  std::vector<std::string> names;
  const auto add = [&](std::initializer_list<std::string_view> more) {
    for (const std::string_view name : more)
      if (!has(name)) names.emplace_back(name);
  };
  const bool of_samples = has("sample"), of_meshes = has("fixed") || has("mobile"), of_labels = has("labels"),
             of_models = has("opensim_model");
  if (of_samples || of_meshes || of_labels || of_models) add({"side"});
  if (of_models) add({"opensim_joint"});
  if (of_labels) add({"fixed_label", "mobile_label", "task"});
  if (of_meshes) add({"fixed", "mobile", "units", "axes"});
  if (of_samples)
    for (const sample::HipMeasure& measure : sample::hip_measures()) add({measure.name});
  if (!of_samples && !of_meshes && !of_labels && !of_models)
    add({"joint", "fixed", "mobile", "labels", "opensim_model", "sample"});
  add({"pelvic_tilt_deg", "species"});
  if (!has("age")) add({"age_years"});
  return names;
}

/// "alpha_angle" of "alpha_angle_deg", "alpha_angle_degrees" and "alpha_angle": the name without the unit at its end.
std::string without_unit(std::string name) {
  constexpr std::string_view units[] = {"_deg", "_degree", "_degrees", "_rad", "_radians", "_mm",    "_cm",
                                        "_m",   "_years",  "_year",    "_yrs", "_yr",      "_months"};
  for (const std::string_view unit : units)
    if (name.ends_with(unit)) return name.substr(0, name.size() - unit.size());
  return name;
}

/// The column that a name is meant for: a letter or two beside it, or with another unit or none. Empty if there is none.
std::string meant_for(const std::string& lower, const std::vector<std::string>& missing) {
  // Names as short as "age" are near to too many others.
  if (lower == "sex" || lower == "gender") return "sex";
  if (std::string near = core::near_name(lower, missing); !near.empty()) return near;
  const auto same = std::find_if(missing.begin(), missing.end(), [&](const std::string& name) {
    return without_unit(name) != name && without_unit(name) == without_unit(lower);
  });
  return same == missing.end() ? std::string() : *same;
}

/// A misspelt column would be carried into the results, and what it says of the joints left out of the answer.
void check_spelling(const StudyTable& table, std::size_t line, const Source& source) {
  const std::vector<std::string> missing = missing_columns(table);
  for (const std::string& name : table.columns) {
    if (is_source(name) || sample::hip_measure_named(name) || name == "pelvic_tilt_deg" || name == "sex")
      continue;
    std::string lower = name;
    std::transform(lower.begin(), lower.end(), lower.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if (const std::string near = meant_for(lower, missing); !near.empty())
      source.fail(fmt::format("line {}: column {}: did you mean '{}'? A covariate needs a name less like it",
                              line, in_quotes(name), near));
  }
}

/// Longest name that HDF5 takes.
constexpr std::size_t longest_name = 1000;
bool is_control_byte(char c) {
  return static_cast<unsigned char>(c) < 0x20 || c == 0x7f;
}

std::string carried_name(const std::string& name) {
  return !is_source(name) && is_result_column(name) ? "table_" + name : name;
}

void check_columns(const StudyTable& table, std::size_t line, const Source& source) {
  const auto fail = [&](std::string_view what) { source.fail(fmt::format("line {}: {}", line, what)); };
  if (table.columns.size() == 1 && table.columns[0].find_first_of(";\t") != std::string::npos)
    fail(fmt::format("{}: columns must be separated by commas", in_quotes(table.columns[0])));
  std::set<std::string> known;
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    const std::string& name = table.columns[c];
    if (name.empty()) fail(fmt::format("column {} has no name", c + 1));
    if (name == "." || name.find_first_of("/\\") != name.npos)
      fail(fmt::format("column {}: a name is no point and has no slash", in_quotes(name)));
    if (std::any_of(name.begin(), name.end(), is_control_byte))
      fail(fmt::format("column {}: a name has no control characters", in_quotes(name)));
    if (name.size() > longest_name)
      fail(
          fmt::format("column {} has a name of {} bytes: {} are the most", c + 1, name.size(), longest_name));
    if (!known.insert(carried_name(name)).second)
      fail(fmt::format("column {} is there twice", in_quotes(name)));
  }
  if (!known.contains("id")) fail("there is no column 'id'");
  if (known.contains("age") && known.contains("age_years"))
    fail("columns 'age' and 'age_years' are one: leave one out");
  check_spelling(table, line, source);
}

void check_ids(const StudyTable& table, const Source& source) {
  std::map<std::string_view, std::size_t> line_of;
  for (const StudyRow& row : table.rows) {
    const std::string& id = table.id(row);
    if (id.empty()) source.fail(fmt::format("line {}: id is empty", row.line));
    const auto [first, is_new] = line_of.emplace(id, row.line);
    if (!is_new)
      source.fail(fmt::format("line {}: id {} is that of line {}", row.line, in_quotes(id), first->second));
  }
}

bool is_number_or_empty(const std::string& field) {
  double number;
  return field.empty() || parse_number(field, number);
}

std::vector<CarriedColumn> carried_of(const StudyTable& table) {
  std::vector<CarriedColumn> carried;
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    if (is_source(table.columns[c])) continue;
    const bool numbers = std::all_of(table.rows.begin(), table.rows.end(),
                                     [&](const StudyRow& row) { return is_number_or_empty(row.fields[c]); });
    carried.push_back({c, carried_name(table.columns[c]), numbers});
  }
  return carried;
}

}  // namespace

std::string_view StudyTable::field(const StudyRow& row, std::string_view column) const noexcept {
  const auto found = std::find(columns.begin(), columns.end(), column);
  return found == columns.end() ? std::string_view()
                                : row.fields[static_cast<std::size_t>(found - columns.begin())];
}

std::vector<std::string> StudyTable::carried_fields(const StudyRow& row) const {
  std::vector<std::string> fields;
  for (const CarriedColumn& each : carried) fields.push_back(csv_field(row.fields[each.column]));
  return fields;
}

std::string StudyTable::place(const StudyRow& row, std::string_view column) const {
  return fmt::format("{}: line {}: column '{}'", path.string(), row.line, column);
}

StudyTable read_study_table(const std::filesystem::path& path) {
  if (core::lower_case(path.extension().string()) == ".toml")
    throw FileError(fmt::format(
        "{0}: is a joint file, not a table: condyle rom {0} has its limits; a table has a row per "
        "joint, id,joint and below hip1,{0}",
        path.string()));
  const std::string bytes = read_whole_file(path), name = path.string();
  const Source source{without_byte_order_mark(bytes), name};
  if (const std::size_t end = end_of_utf8(source.bytes); end < source.bytes.size())
    source.fail(fmt::format("line {}: is not UTF-8 (Latin-1?): save the table as UTF-8",
                            TextCursor(source, end).line()));
  StudyTable table{path, digest_of(bytes), {}, {}, {}};
  TextCursor cursor(source);
  while (!cursor.at_end()) {
    const std::size_t line = cursor.line();
    const std::string_view text = cursor.rest_of_line();
    if (trimmed(text).empty() || trimmed(text).starts_with('#')) continue;
    std::vector<std::string> fields = csv_fields(text, line, source);
    if (table.columns.empty()) {
      table.columns = std::move(fields);
      check_columns(table, line, source);
      continue;
    }
    if (fields.size() != table.columns.size())
      source.fail(fmt::format("line {}: {} fields where there are {} columns", line, fields.size(),
                              table.columns.size()));
    // Texts of HDF5 end at such a character.
    if (text.find('\0') != text.npos) source.fail(fmt::format("line {}: has a character 0", line));
    table.rows.push_back({table.rows.size() + 1, line, std::move(fields)});
  }
  if (table.columns.empty()) source.fail("has no names of columns");
  if (table.rows.empty()) source.fail("has no row");
  table.id_column = static_cast<std::size_t>(std::find(table.columns.begin(), table.columns.end(), "id") -
                                             table.columns.begin());
  check_ids(table, source);
  table.carried = carried_of(table);
  return table;
}

}  // namespace condyle::io
