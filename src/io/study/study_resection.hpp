#pragma once

#include <optional>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "condyle/answer.hpp"
#include "condyle/io/joint_file.hpp"
#include "condyle/io/study.hpp"
#include "io/result/result_column.hpp"

namespace condyle::io {

/// All columns of hips.csv on resections begin so.
inline constexpr std::string_view resection_prefix = "resect_";

/// Columns of hips.csv of a study with resections: what goes, how far each target is reached, and what must be read with it.
std::vector<ResultColumn> resection_columns(const StudyResection& resection);
/// Columns of limits.csv: how far each motion goes without the bone.
std::vector<ResultColumn> resected_limit_columns();

/// The fields of these columns, of one joint; all but `resect_none` are empty if its meshes allow no plan.
struct ResectionFields {
  std::vector<std::string> of_hip;
  std::vector<std::vector<std::string>> of_limits;  ///< in the order of the motions
};

/// The columns of a joint whose limits are computed for `range`. Empty if it was stopped. Throws UsageError for a motion that the joint does
/// not have and a target beyond its range.
std::optional<ResectionFields> resection_fields(const LoadedJoint& loaded, const StudyResection& resection,
                                                const RangeRequest& range, std::stop_token stop);

}  // namespace condyle::io
