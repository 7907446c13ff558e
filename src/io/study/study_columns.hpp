#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "answer/records/record.hpp"
#include "condyle/io/study.hpp"
#include "io/result/result_column.hpp"

namespace condyle::io {

struct StudyTable;

/// The columns of the three tables of results.
struct StudyColumns {
  std::vector<ResultColumn> limits, hips, failures;
};

/// Columns for this table and these options.
StudyColumns study_columns(const StudyTable& table, const StudyOptions& options);

/// Which columns of limits a study has.
struct LimitColumns {
  bool bands, follows;

  bool operator()(const FieldColumn& column) const noexcept;
};
LimitColumns limit_columns_of(const StudyTable& table, const StudyOptions& options);

/// Whether some study has a column of this name.
bool is_result_column(std::string_view name);

/// The names as a header line.
std::string header_of(const std::vector<ResultColumn>& columns);

/// The data dictionary: columns.csv, and as that file is read back.
std::string columns_csv(const StudyColumns& columns);
StudyColumns read_columns_csv(std::string_view text, std::string_view name);

}  // namespace condyle::io
