#include "io/study/study_h5.hpp"

#include <limits>

#include "io/file/csv_fields.hpp"
#include "io/file/h5_image.hpp"

namespace condyle::io {
namespace {

/// Column by column.
std::vector<std::vector<std::string>> fields_of(const std::string& text, std::size_t columns) {
  const Source source{text, "results"};
  TextCursor cursor(source);
  cursor.rest_of_line();
  std::vector<std::vector<std::string>> by_column(columns);
  while (!cursor.at_end()) {
    const std::size_t line = cursor.line();
    std::vector<std::string> fields = csv_fields(cursor.rest_of_line(), line, source);
    for (std::size_t c = 0; c < columns; ++c) by_column[c].push_back(std::move(fields.at(c)));
  }
  return by_column;
}

std::vector<double> numbers_of(const std::vector<std::string>& fields) {
  std::vector<double> numbers;
  for (const std::string& field : fields) {
    double number = std::numeric_limits<double>::quiet_NaN();
    parse_number(field, number);
    numbers.push_back(number);
  }
  return numbers;
}

void add_table(H5Image& file, const std::string& group, const std::vector<ResultColumn>& columns,
               const std::string& text) {
  file.group(group);
  const auto fields = fields_of(text, columns.size());
  for (std::size_t c = 0; c < columns.size(); ++c) {
    const std::string path = group + "/" + columns[c].name;
    if (columns[c].kind == ColumnKind::text)
      file.texts(path, fields[c]);
    else
      file.numbers(path, numbers_of(fields[c]), fields[c].size(), 0);
    file.attribute(path, "unit", columns[c].unit);
    file.attribute(path, "meaning", columns[c].meaning);
  }
}

}  // namespace

std::optional<std::string> study_h5(const StudyColumns& columns, const StudyTexts& texts) {
  H5Image file;
  add_table(file, "/limits", columns.limits, texts.limits);
  add_table(file, "/hips", columns.hips, texts.hips);
  add_table(file, "/failures", columns.failures, texts.failures);
  return file.bytes();
}

}  // namespace condyle::io
