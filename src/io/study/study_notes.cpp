#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "condyle/error.hpp"
#include "condyle/range_of_motion.hpp"
#include "io/file/csv_fields.hpp"
#include "io/file/failure.hpp"
#include "io/study/study_columns.hpp"
#include "io/study/study_files.hpp"

namespace condyle::io {
namespace {

std::size_t place_of(const std::vector<ResultColumn>& columns, std::string_view name) {
  const auto found = std::find_if(columns.begin(), columns.end(),
                                  [&](const ResultColumn& each) { return each.name == name; });
  return static_cast<std::size_t>(found - columns.begin());
}

/// Calls back with the fields of each row below the header until one call returns false.
template <class Row>
void each_row(const std::string& text, const char* name, const Row& row) {
  const Source source{text, name};
  TextCursor cursor(source);
  cursor.rest_of_line();
  while (!cursor.at_end()) {
    const std::size_t line = cursor.line();
    if (!row(csv_fields(cursor.rest_of_line(), line, source))) return;
  }
}

}  // namespace

std::vector<NotedJoint> noted_joints(const StudyResults& results) {
  const auto columns = read_columns_csv(results.columns, "columns.csv").hips;
  const std::size_t id = place_of(columns, "id"), notes = place_of(columns, "notes");
  std::vector<NotedJoint> noted;
  each_row(results.texts.hips, "hips.csv", [&](const std::vector<std::string>& fields) {
    if (!fields.at(notes).empty()) noted.push_back({fields.at(id), fields.at(notes)});
    return true;
  });
  return noted;
}

std::optional<StudyFailure> first_failure(const StudyResults& results) {
  const auto columns = read_columns_csv(results.columns, "columns.csv").failures;
  const std::size_t code = place_of(columns, "exit_code"), message = place_of(columns, "message");
  std::optional<StudyFailure> first;
  each_row(results.texts.failures, "failures.csv", [&](const std::vector<std::string>& fields) {
    first.emplace(StudyFailure{std::stoi(fields.at(code)), fields.at(message)});
    return false;
  });
  return first;
}

void require_answered(const StudyDone& done, const std::filesystem::path& table) {
  if (done.joints > 0 || !done.first_failure) return;
  const std::string text = fmt::format("{}: none of {} joints was answered; the first one: {}",
                                       table.string(), done.failures, done.first_failure->message);
  switch (done.first_failure->exit_code) {
    case io::bad_file:
      throw FileError(text);
    case io::unfit_mesh:
      throw MeshError(text);
    case io::reference_contact:
      throw motion::ReferenceContactError(text);
    default:
      throw std::runtime_error(text);
  }
}

}  // namespace condyle::io
