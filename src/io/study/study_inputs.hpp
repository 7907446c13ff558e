#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "io/file/input_recorder.hpp"
#include "io/result/json.hpp"
#include "io/study/study_table.hpp"

namespace condyle::io {

/// What the rows of a study or of a shard read, each input once. Paths are from the table's folder, so that a study may be moved
/// with its table.
struct StudyInputs {
  std::vector<Input> all;
  std::vector<std::vector<std::size_t>> of_rows;  ///< places in `all`, row by row

  /// The same with what they are now; `folder` is the table's.
  StudyInputs now(const std::filesystem::path& folder) const;
};

/// Gathers what each row recorded.
StudyInputs study_inputs(const std::filesystem::path& folder, std::span<const std::vector<Input>> of_rows);

/// Those of shards, one after the other, as a run of the whole table gathers them.
StudyInputs joined(std::span<const StudyInputs> shards);

/// SHA-256 of the row and of the contents of the files that it read.
std::string inputs_sha256(const StudyRow& row, std::span<const Input> inputs);

/// As study.json has them, and back: FileError for a row whose inputs are not there.
Json inputs_json(const StudyInputs& inputs);
StudyInputs inputs_in(const Json& json);

/// Throws FileError that names the first input which is another now than when `shard` was computed. What is no longer to be found is not
/// held against it: shards may be merged where their inputs are not.
void check_unchanged(std::span<const Input> inputs, const std::filesystem::path& folder,
                     const std::string& shard);

}  // namespace condyle::io
