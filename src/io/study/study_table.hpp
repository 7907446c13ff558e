#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "condyle/io/mesh_file.hpp"

namespace condyle::io {

/// A row of a study's table.
struct StudyRow {
  std::size_t number;  ///< 1 is the first one
  std::size_t line;
  std::vector<std::string> fields;  ///< as many as there are columns
};

/// A column that goes into the results.
struct CarriedColumn {
  std::size_t column;
  std::string name;  ///< there: its own, behind "table_" where results have a column of that name
  bool is_number;    ///< every field that is not empty is one
};

/// The table of a study, of which only the header and the ids were checked: what is wrong with another field is the failure of
/// its row.
struct StudyTable {
  std::filesystem::path path;
  FileDigest digest;
  std::vector<std::string> columns;
  std::vector<CarriedColumn> carried;
  std::vector<StudyRow> rows;

  /// Empty if the table has no such column.
  std::string_view field(const StudyRow& row, std::string_view column) const noexcept;
  const std::string& id(const StudyRow& row) const noexcept { return row.fields[id_column]; }
  /// The fields that are carried, as CSV has them.
  std::vector<std::string> carried_fields(const StudyRow& row) const;
  /// "table.csv: line 7: column 'side'", for messages.
  std::string place(const StudyRow& row, std::string_view column) const;

  std::size_t id_column = 0;
};

/// Raises FileError: no header, a column without a name or there twice, no column id, that is longer or shorter than the header, an id that is empty or there twice, no row.
StudyTable read_study_table(const std::filesystem::path& path);

}  // namespace condyle::io
