#pragma once

#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "condyle/io/joint_file.hpp"
#include "condyle/limit_band.hpp"
#include "io/result/result_column.hpp"
#include "io/study/study_table.hpp"

namespace condyle::io {

/// Columns of hips.csv of a study with measures: one for each measure, and what they must be read with. With bands two more for each.
std::vector<ResultColumn> measure_columns(bool with_bands);

/// The fields of these columns; a measure that the meshes do not show is empty. The pelvis is tilted as the row's column
/// pelvic_tilt_deg says. Empty if it was stopped. Throws FileError for a tilt that is no number of degrees from -60 to 60, UsageError for
/// what is no hip.
std::optional<std::vector<std::string>> measure_fields(const StudyTable& table, const StudyRow& row,
                                                       const LoadedJoint& loaded,
                                                       const std::optional<BandRequest>& bands,
                                                       std::stop_token stop);

}  // namespace condyle::io
