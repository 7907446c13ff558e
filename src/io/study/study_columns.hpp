#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "condyle/io/study.hpp"
#include "io/result/limit_fields.hpp"

namespace condyle::io {

struct StudyTable;

/// The columns of the three tables of results.
struct StudyColumns {
  std::vector<ResultColumn> limits, hips, failures;
};

/// Columns for this table and these options.
StudyColumns study_columns(const StudyTable& table, const StudyOptions& options);

/// The values of limits.csv that `condyle rom` has too, by these options.
std::vector<const LimitField*> limit_fields_of(const StudyTable& table, const StudyOptions& options);

/// Whether some study has a column of this name.
bool is_result_column(std::string_view name);

/// The names as a header line.
std::string header_of(const std::vector<ResultColumn>& columns);

/// The data dictionary: columns.csv, and as that file is read back.
std::string columns_csv(const StudyColumns& columns);
StudyColumns read_columns_csv(std::string_view text, std::string_view name);

}  // namespace condyle::io
