#include "io/motion/motion_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "condyle/error.hpp"
#include "io/file/compressed.hpp"
#include "io/file/plain_text.hpp"
#include "io/file/words.hpp"
#include "io/motion/table_builder.hpp"

namespace condyle::io {
namespace {

std::size_t place_of(const MotionTable& table, std::string_view lower_case_name) {
  const auto at = std::find_if(table.columns.begin(), table.columns.end(), [&](const std::string& name) {
    return io::lower_case(name) == lower_case_name;
  });
  return static_cast<std::size_t>(at - table.columns.begin());
}

/// Whether two rows hold the same numbers, gaps included.
bool are_equal(const MotionTable& table, std::size_t a, std::size_t b) {
  return std::all_of(table.values.begin(), table.values.end(), [&](const std::vector<double>& column) {
    return column[a] == column[b] || (std::isnan(column[a]) && std::isnan(column[b]));
  });
}

/// Leaves out each row that repeats the one before it, its time included: OpenSim's RRA, CMC and analyses write their last row twice.
void drop_repeated_rows(MotionTable& table) {
  const std::size_t column = time_column(table);
  if (column == table.columns.size()) return;
  std::vector<std::size_t> kept;
  std::size_t first_repeated = 0;
  for (std::size_t row = 0; row < table.rows; ++row) {
    const bool is_repeated =
        row > 0 && !std::isnan(table.values[column][row]) && are_equal(table, row - 1, row);
    if (!is_repeated)
      kept.push_back(row);
    else if (first_repeated == 0)
      first_repeated = row;
  }
  const std::size_t repeated = table.rows - kept.size();
  if (repeated == 0) return;
  table.processing.push_back(
      fmt::format("line {} repeats line {}, its time included: {} read once",
                  table.line_of_row[first_repeated], table.line_of_row[first_repeated - 1],
                  repeated == 1 ? std::string("the row is")
                                : fmt::format("this row and {} others like it are", repeated - 1)));
  for (std::size_t i = 0; i < kept.size(); ++i) {
    table.line_of_row[i] = table.line_of_row[kept[i]];
    for (std::vector<double>& values : table.values) values[i] = values[kept[i]];
  }
  table.line_of_row.resize(kept.size());
  for (std::vector<double>& values : table.values) values.resize(kept.size());
  table.rows = kept.size();
}

void check_times(const MotionTable& table, const Source& source) {
  const std::size_t column = time_column(table);
  if (column == table.columns.size()) return;
  const auto& times = table.values[column];
  for (std::size_t row = 0; row < table.rows; ++row) {
    const auto fail = [&](std::string_view what) {
      source.fail(fmt::format("line {}: column {}: {}", table.line_of_row[row],
                              in_quotes(table.columns[column]), what));
    };
    if (std::isnan(times[row])) fail("a time must not be a gap");
    if (row > 0 && !(times[row] > times[row - 1]))
      fail(fmt::format("{} does not come after {}: times must increase", times[row], times[row - 1]));
  }
}

}  // namespace

void TableBuilder::name_columns(std::vector<std::string> names, std::size_t line) {
  std::set<std::string_view> known;
  for (std::size_t c = 0; c < names.size(); ++c) {
    double number = 0;
    if (end_of_utf8(names[c]) < names[c].size())
      source_.fail(fmt::format("line {}: column {} is not UTF-8 (Latin-1?): save the table as UTF-8", line,
                               in_quotes(names[c])));
    if (names[c].empty()) source_.fail(fmt::format("line {}: column {} has no name", line, c + 1));
    if (parse_number(names[c], number))
      source_.fail(
          fmt::format("line {}: {} should be the name of column {}: the names of the columns are missing",
                      line, in_quotes(names[c]), c + 1));
    if (!known.insert(names[c]).second)
      source_.fail(fmt::format("line {}: column {} is there twice", line, in_quotes(names[c])));
  }
  table.columns = std::move(names);
  table.values.resize(table.columns.size());
}

double TableBuilder::cell(std::string_view text, std::size_t column, std::size_t line) const {
  if (text.empty()) return std::nan("");
  double value = 0;
  const auto fail = [&](std::string_view what) {
    source_.fail(fmt::format("line {}: column {}: {}", line, in_quotes(table.columns[column]), what));
  };
  if (!parse_number(text, value)) fail(fmt::format("{} should be a number", in_quotes(text)));
  if (std::isinf(value)) fail(fmt::format("{} is not finite", in_quotes(text)));
  return value;
}

void TableBuilder::add_row(std::span<const std::string_view> cells, std::size_t line) {
  if (cells.size() != table.columns.size())
    source_.fail(fmt::format("line {}: has {} values, and there are {} columns", line, cells.size(),
                             table.columns.size()));
  for (std::size_t c = 0; c < cells.size(); ++c) table.values[c].push_back(cell(cells[c], c, line));
  table.line_of_row.push_back(line);
}

MotionTable TableBuilder::finish() {
  table.rows = table.line_of_row.size();
  if (table.rows == 0) source_.fail("has no rows of numbers");
  drop_repeated_rows(table);
  check_times(table, source_);
  return std::move(table);
}

std::size_t time_column(const MotionTable& table) {
  for (const char* name : {"time", "time_s"})
    if (const std::size_t at = place_of(table, name); at < table.columns.size()) return at;
  return place_of(table, "frame");
}

bool is_of_opensim(const std::filesystem::path& path) {
  const std::string extension = io::lower_case(path.extension().string());
  const bool of_opensim = extension == ".mot" || extension == ".sto";
  if (!of_opensim && extension != ".csv")
    throw FileError(fmt::format("{}: unknown extension '{}': .mot, .sto and .csv are read", path.string(),
                                path.extension().string()));
  return of_opensim;
}

MotionTable motion_table_of(std::string_view bytes, const std::filesystem::path& path) {
  const std::string name = path.string();
  const bool of_opensim = is_of_opensim(path);
  const Source source{without_byte_order_mark(bytes), name};
  if (const auto packer = packed_by(bytes); !packer.empty())
    source.fail(fmt::format("is compressed by {}: uncompress it first", packer));
  if (io::trimmed(source.bytes).empty()) source.fail("is empty");
  MotionTable table = of_opensim ? io::read_opensim_table(source) : io::read_csv_table(source);
  table.path = path;
  table.digest = digest_of(bytes);
  return table;
}

FrameTimes frame_times(const MotionTable& table) {
  FrameTimes times;
  const std::size_t column = io::time_column(table);
  if (column < table.columns.size()) {
    times.values = table.values[column];
    times.in_seconds = io::lower_case(table.columns[column]) != "frame";
    return times;
  }
  for (std::size_t row = 0; row < table.rows; ++row) times.values.push_back(static_cast<double>(row));
  times.in_seconds = false;
  return times;
}

}  // namespace condyle::io
