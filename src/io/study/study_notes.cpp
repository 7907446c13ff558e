#include <algorithm>

#include "io/file/csv_fields.hpp"
#include "io/study/study_columns.hpp"
#include "io/study/study_files.hpp"

namespace condyle::io {

std::vector<NotedJoint> noted_joints(const StudyResults& results) {
  const auto columns = read_columns_csv(results.columns, "columns.csv").hips;
  const auto place_of = [&](std::string_view name) {
    return static_cast<std::size_t>(std::find_if(columns.begin(), columns.end(),
                                                 [&](const StudyColumn& each) { return each.name == name; }) -
                                    columns.begin());
  };
  const std::size_t id = place_of("id"), notes = place_of("notes");
  std::vector<NotedJoint> noted;
  const Source source{results.texts.hips, "hips.csv"};
  TextCursor cursor(source);
  cursor.rest_of_line();
  while (!cursor.at_end()) {
    const std::size_t line = cursor.line();
    const std::vector<std::string> fields = csv_fields(cursor.rest_of_line(), line, source);
    if (!fields.at(notes).empty()) noted.push_back({fields.at(id), fields.at(notes)});
  }
  return noted;
}

}  // namespace condyle::io
