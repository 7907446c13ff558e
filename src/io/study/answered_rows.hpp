#pragma once

#include <filesystem>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "io/study/study_answer.hpp"

namespace condyle::io {

/// Answers of rows in a hidden file of the study's folder, until the tables are written: the next run takes those whose row, files and
/// options are the same. A line that was broken off, or that two runs wrote into, counts for nothing.
class AnsweredRows {
 public:
  /// `common`: all that answers depend on but rows and what is read for them. Paths are from the folder of `table`.
  AnsweredRows(const std::filesystem::path& folder, const std::filesystem::path& table,
               std::span<const StudyRow> rows, std::string common);

  /// Answers of an earlier run, row by row.
  const std::vector<std::optional<StudyAnswer>>& earlier() const noexcept { return earlier_; }
  /// From any thread. A row that cannot be kept will be computed again.
  void add(const StudyRow& row, const StudyAnswer& answer);
  void remove() const noexcept;

 private:
  std::string key_of(const StudyRow& row) const;
  void read(std::span<const StudyRow> rows);

  std::filesystem::path file_, table_folder_;
  std::string common_;
  std::vector<std::optional<StudyAnswer>> earlier_;
  std::mutex mutex_;
};

}  // namespace condyle::io
