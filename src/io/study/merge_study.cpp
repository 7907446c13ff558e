#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

#include "condyle/error.hpp"
#include "condyle/io/study.hpp"
#include "io/file/replaced_files.hpp"
#include "io/file/whole_file.hpp"
#include "io/mesh/parse.hpp"
#include "io/study/study_files.hpp"

namespace condyle::io {
namespace {

namespace fs = std::filesystem;

/// Into how many shards the study was parted, by the names of their folders.
std::size_t shards_in(const fs::path& folder) {
  std::set<std::size_t> counts;
  std::error_code error;
  for (fs::directory_iterator entry(folder / "shards", error), end; !error && entry != end; ++entry) {
    const std::string name = entry->path().filename().string();
    const std::size_t mark = name.find("_of_");
    std::size_t number, of;
    if (mark != name.npos && io::parse_number(std::string_view(name).substr(0, mark), number) &&
        io::parse_number(std::string_view(name).substr(mark + 4), of))
      counts.insert(of);
  }
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
  whole.record.joints += shard.record.joints;
  whole.record.failures += shard.record.failures;
}

/// The table of the study may lie in its folder under a name that the results have.
void check_keeps_the_table(const fs::path& folder, const StudyRecord& record) {
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

StudyDone merge_study(const fs::path& folder) {
  const std::size_t of = shards_in(folder);
  check_all_there(folder, of);
  StudyResults whole = io::read_study(io::shard_folder(folder, {1, of}));
  check_keeps_the_table(folder, whole.record);
  check_keeps_the_shards(folder, of);
  for (std::size_t number = 2; number <= of; ++number) {
    const fs::path shard = io::shard_folder(folder, {number, of});
    append(whole, io::read_study(shard), shard);
  }
  if (whole.record.joints + whole.record.failures != whole.record.table_rows)
    throw FileError(fmt::format("{}: {} rows in the shards where the table has {}", folder.string(),
                                whole.record.joints + whole.record.failures, whole.record.table_rows));
  whole.record.key.clear();
  whole.record.is_merged = true;
  return {whole.record.joints,
          whole.record.failures,
          io::first_failure(whole),
          false,
          io::write_study(folder, whole),
          io::noted_joints(whole)};
}

}  // namespace condyle::io
