#pragma once

#include <optional>
#include <string>

#include "io/study/study_columns.hpp"

namespace condyle::io {

/// The three tables of a study as CSV text, each with its header line.
struct StudyTexts {
  std::string limits, hips, failures;
};

/// The same tables as an HDF5 file: a group per table, a data set per column with its unit and meaning as attributes; an empty
/// number is nan. The same bytes for the same tables. None from a program built without HDF5.
std::optional<std::string> study_h5(const StudyColumns& columns, const StudyTexts& texts);

}  // namespace condyle::io
