#include <fmt/format.h>

#include "io/file/csv_fields.hpp"
#include "io/file/words.hpp"
#include "io/motion/table_builder.hpp"

namespace condyle::io {
namespace {

/// XMALab names the sixteen columns of a body R11 R12 R13 01 R21 R22 R23 02 R31 R32 R33 03 TX TY TY 1: the second TY is
/// a slip of the program for TZ (saveRigidBodyTransformations in its src/core/Trial.cpp).
void name_third_translation(std::vector<std::string>& names, std::vector<std::string>& processing) {
  for (std::size_t c = 1; c + 2 < names.size(); ++c) {
    const std::size_t mark = names[c].rfind("_TY");
    if (mark == names[c].npos || names[c + 1] != names[c]) continue;
    const std::string body = names[c].substr(0, mark), ending = names[c].substr(mark + 3);
    if (names[c - 1] != body + "_TX" + ending || names[c + 2] != body + "_1" + ending) continue;
    names[c + 1] = body + "_TZ" + ending;
    processing.push_back(
        fmt::format("column {} is there twice, as XMALab writes it: the second is read as {}",
                    io::in_quotes(names[c]), io::in_quotes(names[c + 1])));
  }
}

}  // namespace

MotionTable read_csv_table(const Source& source) {
  TextCursor cursor(source);
  TableBuilder builder(source);
  MotionTable& table = builder.table;
  std::size_t empty_line = 0;
  while (!cursor.at_end()) {
    const std::size_t line = cursor.line();
    const std::string_view text = cursor.rest_of_line();
    if (trimmed(text).starts_with('#')) continue;
    if (trimmed(text).empty()) {
      if (!table.line_of_row.empty() && empty_line == 0) empty_line = line;
      continue;
    }
    if (empty_line != 0) source.fail(fmt::format("line {}: is empty, and rows follow", empty_line));
    std::vector<std::string> fields = csv_fields(text, line, source);
    if (table.columns.empty()) {
      if (fields.size() == 1 && fields[0].find_first_of(";\t") != std::string::npos)
        source.fail(
            fmt::format("line {}: {}: columns must be separated by commas", line, in_quotes(fields[0])));
      name_third_translation(fields, table.processing);
      builder.name_columns(std::move(fields), line);
    } else {
      builder.add_row(std::vector<std::string_view>(fields.begin(), fields.end()), line);
    }
  }
  if (table.columns.empty()) source.fail("has no names of columns");
  return builder.finish();
}

}  // namespace condyle::io
