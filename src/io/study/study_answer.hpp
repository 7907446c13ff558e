#pragma once

#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "condyle/io/study.hpp"
#include "io/file/input_recorder.hpp"
#include "io/study/study_table.hpp"

namespace condyle::io {

/// Outcome of one row: lines of limits.csv and one of hips.csv, or one of failures.csv.
struct StudyAnswer {
  std::string limits, hip, failure;
  std::vector<Input> inputs;  ///< what it read
};

/// The lines of an answer whose reading `read` records. Throws if there is none, and where a joint looks wrong and bad ones end
/// the run; empty if it was stopped.
std::optional<StudyAnswer> answer_of(const StudyTable& table, const StudyRow& row, const Study& study,
                                     const InputRecorder& read, std::stop_token stop);

/// The line of the exception that is being handled.
StudyAnswer failure_of(const StudyTable& table, const StudyRow& row, const InputRecorder& read);

}  // namespace condyle::io
