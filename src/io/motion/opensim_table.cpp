#include <fmt/format.h>

#include <cstdint>
#include <map>

#include "io/file/words.hpp"
#include "io/motion/table_builder.hpp"

namespace condyle::io {
namespace {

/// The lines before `endheader`: "key=value" in any order, and free text.
struct TableHeader {
  struct Entry {
    std::string value;
    std::size_t line = 0;
  };
  std::map<std::string, Entry> entries;  ///< by key in lower case
  std::optional<bool> prose_in_degrees;  ///< what "Angles are in degrees." among the free text says
};

TableHeader read_header(TextCursor& cursor, const Source& source) {
  TableHeader header;
  while (!cursor.at_end()) {
    const std::size_t line = cursor.line();
    const std::string_view text = trimmed(cursor.rest_of_line());
    const std::string lower = io::lower_case(text);
    if (lower == "endheader") return header;
    const std::size_t equals = text.find('=');
    const std::string_view key = trimmed(text.substr(0, equals));
    if (equals != text.npos && key.find_first_of(" \t") == key.npos) {
      const std::string value(trimmed(text.substr(equals + 1)));
      const auto [known, is_new] =
          header.entries.try_emplace(io::lower_case(key), TableHeader::Entry{value, line});
      if (!is_new && known->second.value != value)
        source.fail(fmt::format("line {}: {} is given twice, with different values", line, in_quotes(key)));
    } else if (lower.find("angles are in degrees") != lower.npos) {
      header.prose_in_degrees = true;
    } else if (lower.find("angles are in radians") != lower.npos) {
      header.prose_in_degrees = false;
    }
  }
  source.fail("has no line 'endheader': the header does not end");
}

std::optional<bool> in_degrees(const TableHeader& header, const Source& source) {
  const auto entry = header.entries.find("indegrees");
  if (entry == header.entries.end()) return std::nullopt;
  const std::string value = io::lower_case(entry->second.value);
  if (value != "yes" && value != "no")
    source.fail(fmt::format("line {}: inDegrees: must be yes or no, not {}", entry->second.line,
                            in_quotes(entry->second.value)));
  return value == "yes";
}

/// Tables of vectors and quaternions have several numbers to a cell.
void check_data_type(const TableHeader& header, const Source& source) {
  const auto entry = header.entries.find("datatype");
  if (entry != header.entries.end() && io::lower_case(entry->second.value) != "double")
    source.fail(fmt::format("line {}: DataType: must be double, not {}", entry->second.line,
                            in_quotes(entry->second.value)));
}

/// A count that the header promises, against what is there.
void compare_count(const TableHeader& header, const char* key, const char* what, std::size_t counted,
                   const Source& source, std::vector<std::string>& processing) {
  const auto entry = header.entries.find(io::lower_case(key));
  if (entry == header.entries.end()) return;
  std::uint64_t promised = 0;
  if (!parse_number(entry->second.value, promised))
    source.fail(fmt::format("line {}: {}: {} should be a whole number", entry->second.line, key,
                            in_quotes(entry->second.value)));
  if (promised != counted)
    processing.push_back(fmt::format("the header promises {} {} and the file has {}: all of them are read",
                                     promised, what, counted));
}

/// What stands between tabs, without blanks around it.
std::vector<std::string> split_at_tabs(std::string_view line) {
  std::vector<std::string> fields;
  for (line = trimmed(line); true;) {
    const std::size_t tab = line.find('\t');
    fields.emplace_back(trimmed(line.substr(0, tab)));
    if (tab == line.npos) return fields;
    line.remove_prefix(tab + 1);
  }
}

/// The names of the columns: the words of their line, or what stands between its tabs where only that is as many as the first
/// row has values. Then names have blanks.
std::vector<std::string> column_names(std::string_view line, std::optional<std::size_t> values) {
  const std::vector<std::string_view> words = io::words_of(line);
  if (values && words.size() != *values)
    if (auto fields = split_at_tabs(line); fields.size() == *values) return fields;
  return {words.begin(), words.end()};
}

}  // namespace

MotionTable read_opensim_table(const Source& source) {
  TextCursor cursor(source);
  const TableHeader header = read_header(cursor, source);
  TableBuilder builder(source);
  MotionTable& table = builder.table;
  check_data_type(header, source);
  table.in_degrees = in_degrees(header, source);
  if (table.in_degrees && header.prose_in_degrees && *table.in_degrees != *header.prose_in_degrees)
    table.processing.push_back(fmt::format(
        "the header says inDegrees={0} and in words that angles are in {1}: inDegrees={0} is followed",
        *table.in_degrees ? "yes" : "no", *header.prose_in_degrees ? "degrees" : "radians"));
  std::size_t empty_line = 0, names_line = 0;
  std::string_view names;
  while (!cursor.at_end()) {
    const std::size_t line = cursor.line();
    const std::string_view text = cursor.rest_of_line();
    const std::vector<std::string_view> words = io::words_of(text);
    if (words.empty()) {
      if (!table.line_of_row.empty() && empty_line == 0) empty_line = line;
    } else if (names.empty()) {
      names = text;
      names_line = line;
    } else {
      if (table.columns.empty()) builder.name_columns(column_names(names, words.size()), names_line);
      if (empty_line != 0) source.fail(fmt::format("line {}: is empty, and rows follow", empty_line));
      builder.add_row(words, line);
    }
  }
  if (names.empty()) source.fail("has no names of columns after 'endheader'");
  if (table.columns.empty()) builder.name_columns(column_names(names, std::nullopt), names_line);
  compare_count(header, "nRows", "rows", table.line_of_row.size(), source, table.processing);
  compare_count(header, "nColumns", "columns", table.columns.size(), source, table.processing);
  return builder.finish();
}

}  // namespace condyle::io
