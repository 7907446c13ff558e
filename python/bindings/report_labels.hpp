#pragma once

#include <optional>
#include <string>
#include <tuple>

#include "io/report/report.hpp"

namespace condyle::python {

/// Case, note, date, and whether files are named by their whole paths.
using LabelArguments =
    std::tuple<std::optional<std::string>, std::optional<std::string>, std::optional<std::string>, bool>;

inline io::ReportLabels report_labels_of(const LabelArguments& given) {
  const auto& [case_name, note, date, whole_paths] = given;
  return {case_name, note, date, whole_paths};
}

}  // namespace condyle::python
