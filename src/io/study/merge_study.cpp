#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

#include "condyle/error.hpp"
#include "condyle/io/study.hpp"
#include "condyle/version.hpp"
#include "io/file/replaced_files.hpp"
#include "io/file/whole_file.hpp"
#include "io/result/crate.hpp"
#include "io/study/study_files.hpp"
#include "io/study/study_inputs.hpp"

namespace condyle::io {
namespace {

namespace fs = std::filesystem;

std::size_t shards_in(const fs::path& folder) {
  const std::set<std::size_t> counts = shard_counts(folder);
  if (counts.empty()) throw FileError(fmt::format("{}: there is no shard of a study", folder.string()));
  if (counts.size() > 1)
    throw FileError(fmt::format("{}: shards of {} and of {} lie there: remove those of one run",
                                (folder / "shards").string(), *counts.begin(), *std::next(counts.begin())));
  return *counts.begin();
}

void check_all_there(const fs::path& folder, std::size_t of) {
  std::vector<std::size_t> missing;
  for (std::size_t number = 1; number <= of; ++number)
    if (!io::read_study_record(io::shard_folder(folder, {number, of}))) missing.push_back(number);
  if (missing.empty()) return;
  constexpr std::size_t most_named = 20;
  const std::vector<std::size_t> named(
      missing.begin(), missing.begin() + static_cast<std::ptrdiff_t>(std::min(missing.size(), most_named)));
  throw FileError(fmt::format("{}: {} of {} shards {} missing or not whole: {}{}", folder.string(),
                              missing.size(), of, missing.size() == 1 ? "is" : "are", fmt::join(named, ", "),
                              missing.size() > most_named ? ", ..." : ""));
}

/// A shard whose number is not that of its folder was copied or renamed, and its rows are those of another.
void check_is_of_folder(const StudyRecord& shard, const Shard& named, const fs::path& folder) {
  const std::string file = (folder / "study.json").string();
  if (shard.is_merged || shard.shard.number != named.number || shard.shard.of != named.of)
    throw FileError(
        fmt::format("{}: is of shard {} of {}, in the folder of shard {} of {}: run that shard again", file,
                    shard.shard.number, shard.shard.of, named.number, named.of));
  if (shard.version != version)
    throw FileError(fmt::format("{}: is of version {}, and this is {}: run the shard again", file,
                                shard.version, version));
  const auto before = [&](std::size_t number) { return number * shard.table_rows / named.of; };
  const std::size_t rows = before(named.number) - before(named.number - 1);
  if (shard.joints + shard.failures != rows)
    throw FileError(fmt::format("{}: has {} rows, and shard {} of {} has {} of the table's {}", file,
                                shard.joints + shard.failures, named.number, named.of, rows,
                                shard.table_rows));
}

/// Throws FileError if the table or a file that a shard read is another now; the table if it lies where it did.
void check_inputs(const StudyRecord& shard, const fs::path& folder) {
  const Input table{Input::Kind::file, shard.table, shard.table_digest.sha256};
  check_unchanged({&table, 1}, {}, folder.string());
  check_unchanged(shard.inputs.all, fs::path(shard.table).parent_path(), folder.string());
}

/// Rows of a table without its header line.
std::string_view rows_of(const std::string& text) {
  return std::string_view(text).substr(text.find('\n') + 1);
}

void append(StudyResults& whole, const StudyResults& shard, const fs::path& folder) {
  if (shard.record.family != whole.record.family || shard.columns != whole.columns)
    throw FileError(fmt::format("{}: is of another table, other options or another version than shard 1",
                                folder.string()));
  whole.texts.limits += rows_of(shard.texts.limits);
  whole.texts.hips += rows_of(shard.texts.hips);
  whole.texts.failures += rows_of(shard.texts.failures);
  check_inputs(shard.record, folder);
  whole.record.joints += shard.record.joints;
  whole.record.failures += shard.record.failures;
}

/// The table of the study may lie in its folder under a name that the results have.
void check_keeps_the_table(const fs::path& folder, const StudyRecord& record) {
  const Recording none(nullptr);  // earlier results are no inputs
  for (const fs::path& file : io::study_result_files(folder)) {
    std::error_code ignored;
    if (!fs::is_regular_file(file, ignored)) continue;
    const FileDigest there = digest_of(io::read_whole_file(file));
    if (there.bytes == record.table_digest.bytes && there.sha256 == record.table_digest.sha256)
      throw FileError(file.string() + ": is the table of this study, whose results would be written over it");
  }
}

/// Throws FileError if the results would take the place of a shard's.
void check_keeps_the_shards(const fs::path& folder, std::size_t of) {
  std::vector<fs::path> read;
  for (std::size_t number = 1; number <= of; ++number)
    for (fs::path& file : io::study_result_files(io::shard_folder(folder, {number, of})))
      read.push_back(std::move(file));
  io::check_replaces_none(io::study_result_files(folder), read);
}

}  // namespace

StudyDone merge_study(const fs::path& folder, const std::optional<std::string>& crate_date) {
  if (crate_date) check_crate_date(*crate_date);
  const std::size_t of = shards_in(folder);
  check_all_there(folder, of);
  const fs::path first = io::shard_folder(folder, {1, of});
  StudyResults whole = io::read_study(first);
  check_is_of_folder(whole.record, {1, of}, first);
  check_keeps_the_table(folder, whole.record);
  check_keeps_the_shards(folder, of);
  std::vector<StudyInputs> inputs = {whole.record.inputs};
  for (std::size_t number = 2; number <= of; ++number) {
    const fs::path shard = io::shard_folder(folder, {number, of});
    StudyResults results = io::read_study(shard);
    check_is_of_folder(results.record, {number, of}, shard);
    append(whole, results, shard);
    inputs.push_back(std::move(results.record.inputs));
  }
  check_inputs(whole.record, first);
  whole.record.inputs = joined(inputs);
  if (whole.record.joints + whole.record.failures != whole.record.table_rows)
    throw FileError(fmt::format("{}: {} rows in the shards where the table has {}", folder.string(),
                                whole.record.joints + whole.record.failures, whole.record.table_rows));
  whole.record.key.clear();
  whole.record.is_merged = true;
  return {whole.record.joints,
          whole.record.failures,
          io::first_failure(whole),
          false,
          io::write_study(folder, whole, crate_date),
          io::noted_joints(whole)};
}

}  // namespace condyle::io
