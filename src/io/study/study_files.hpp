#pragma once

#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "condyle/io/study.hpp"
#include "io/study/study_h5.hpp"
#include "io/study/study_inputs.hpp"
#include "io/study/study_table.hpp"

namespace condyle::io {

/// Entries of study.json for the tables beside it.
struct StudyRecord {
  std::string version;
  /// SHA-256 of what the tables depend on: rows, what was read for them, options, version. Empty of merged tables.
  std::string key;
  /// The same in all shards of one table: SHA-256 of the table, options, version and number of shards.
  std::string family;
  std::string options;  ///< JSON
  std::string table;
  FileDigest table_digest;
  std::size_t table_rows = 0;
  Shard shard;
  bool is_merged = false;
  StudyInputs inputs;
  std::size_t joints = 0, failures = 0;
};

/// A study's results in memory, tables without the comments that begin their files.
struct StudyResults {
  StudyRecord record;
  std::string columns;  ///< columns.csv
  StudyTexts texts;
};

/// The joints of hips.csv that have notes.
std::vector<NotedJoint> noted_joints(const StudyResults& results);

/// The first row of failures.csv.
std::optional<StudyFailure> first_failure(const StudyResults& results);

/// Where a shard's results lie: "DIR/shards/3_of_7".
std::filesystem::path shard_folder(const std::filesystem::path& folder, const Shard& shard);
/// Into how many shards a study or a sweep was parted, by the names of their folders.
std::set<std::size_t> shard_counts(const std::filesystem::path& folder);

/// The files that a folder of results has, by their names there.
std::vector<std::filesystem::path> study_result_files(const std::filesystem::path& folder);

/// Makes the folder, which stays, and makes sure that files can be put there. Throws FileError.
void prepare_study_folder(const std::filesystem::path& folder);

/// Writes all files, study.json last, and behind it, with a date, the crate. Returns what was written. Throws FileError.
std::vector<std::filesystem::path> write_study(const std::filesystem::path& folder,
                                               const StudyResults& results,
                                               const std::optional<std::string>& crate_date = {});

/// Reads study.json; empty if there is none that can be read, or if a file beside it is not the one that it was
/// written with, as when a run was killed between two files.
std::optional<StudyRecord> read_study_record(const std::filesystem::path& folder);

/// All of it. Throws FileError if read_study_record() is empty.
StudyResults read_study(const std::filesystem::path& folder);

}  // namespace condyle::io
