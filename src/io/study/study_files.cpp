#include "io/study/study_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "condyle/error.hpp"
#include "io/file/format_version.hpp"
#include "io/file/output_folder.hpp"
#include "io/file/plain_text.hpp"
#include "io/file/whole_file.hpp"
#include "io/mesh/parse.hpp"
#include "io/result/crate.hpp"
#include "io/result/json.hpp"
#include "io/result/scope_text.hpp"

namespace condyle::io {
namespace {

namespace fs = std::filesystem;

constexpr const char* record_name = "study.json";

Json digest_json(const FileDigest& digest) {
  return {{"bytes", digest.bytes}, {"sha256", digest.sha256}};
}

struct NamedFile {
  const char* name;
  std::string contents;
};

/// Provenance of a table, as far as all shards of a study have it in common, so that merged tables are those of one
/// run.
std::string comments_of(const StudyRecord& record) {
  return fmt::format("# condyle_version: {}\n# options: {}\n", record.version, escaped_json(record.options));
}

/// A study's results are no inputs: the next run writes over them.
std::string read_table(const fs::path& path) {
  const Recording none(nullptr);
  std::string text = read_whole_file(path);
  std::size_t header = 0;
  while (header < text.size() && text[header] == '#')
    header = std::min(text.find('\n', header), text.size() - 1) + 1;
  return text.substr(header);
}

Json record_json(const StudyRecord& record, const std::vector<NamedFile>& files) {
  Json json{{"condyle", record.version}, {"format", format_version}};
  json["key"] = record.key.empty() ? Json(nullptr) : Json(record.key);
  json["family"] = record.family;
  json["table"] = {{"path", record.table}};
  json["table"].update(digest_json(record.table_digest));
  json["table"]["rows"] = record.table_rows;
  json["options"] = Json::parse(record.options);
  json["shard"] = {{"number", record.shard.number}, {"of", record.shard.of}};
  json["merged"] = record.is_merged;
  json["joints"] = record.joints;
  json["failures"] = record.failures;
  json["inputs"] = inputs_json(record.inputs);
  for (const NamedFile& file : files) json["files"][file.name] = digest_json(digest_of(file.contents));
  json["scope"] = scope_text();
  return json;
}

StudyRecord record_of(const Json& json) {
  StudyRecord record;
  record.version = json.at("condyle");
  record.key = json.at("key").is_null() ? "" : json.at("key").get<std::string>();
  record.family = json.at("family");
  record.table = json.at("table").at("path");
  record.table_digest = {json.at("table").at("bytes"), json.at("table").at("sha256")};
  record.table_rows = json.at("table").at("rows");
  record.options = json.at("options").dump();
  record.shard = {json.at("shard").at("number"), json.at("shard").at("of")};
  record.is_merged = json.at("merged");
  record.joints = json.at("joints");
  record.failures = json.at("failures");
  record.inputs = inputs_in(json.at("inputs"));
  return record;
}

/// The run is the study, whole or merged of shards: its options and inputs are theirs.
CrateRun crate_run_of(const StudyRecord& record, const std::string& date) {
  CrateRun run{date, "condyle study", "options " + record.options, record.inputs.all};
  run.inputs.insert(run.inputs.begin(), {Input::Kind::file, record.table, record.table_digest.sha256});
  return run;
}

constexpr std::string_view result_names[] = {"limits.csv", "hips.csv",  "failures.csv", "columns.csv",
                                             "study.h5",   record_name, crate_name};

bool is_of_study(std::string_view name) {
  return std::find(std::begin(result_names), std::end(result_names), name) != std::end(result_names);
}

}  // namespace

fs::path shard_folder(const fs::path& folder, const Shard& shard) {
  return folder / "shards" / fmt::format("{}_of_{}", shard.number, shard.of);
}

std::set<std::size_t> shard_counts(const fs::path& folder) {
  std::set<std::size_t> counts;
  std::error_code error;
  for (fs::directory_iterator entry(folder / "shards", error), end; !error && entry != end;
       entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    const std::size_t mark = name.find("_of_");
    std::size_t number = 0, of = 0;
    if (mark != name.npos && parse_number(std::string_view(name).substr(0, mark), number) &&
        parse_number(std::string_view(name).substr(mark + 4), of))
      counts.insert(of);
  }
  return counts;
}

std::vector<fs::path> study_result_files(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const std::string_view name : result_names) files.push_back(folder / name);
  return files;
}

void prepare_study_folder(const fs::path& folder) {
  // Other shards make folders on the same way at the same time; one that was made is never taken away.
  std::error_code error;
  fs::create_directories(folder, error);
  OutputFolder{folder, is_of_study};
}

std::vector<fs::path> write_study(const fs::path& folder, const StudyResults& results,
                                  const std::optional<std::string>& crate_date) {
  const StudyTexts& texts = results.texts;
  const std::optional<std::string> h5 = study_h5(read_columns_csv(results.columns, "columns.csv"), texts);
  const std::string comments = comments_of(results.record);
  std::vector<NamedFile> files = {{"limits.csv", comments + texts.limits},
                                  {"hips.csv", comments + texts.hips},
                                  {"failures.csv", comments + texts.failures},
                                  {"columns.csv", comments + results.columns}};
  if (h5) files.push_back({"study.h5", *h5});
  OutputFolder out(folder, is_of_study, {}, record_name);
  for (const auto& [name, contents] : files) write_whole_file(out.file(name), contents);
  write_whole_file(out.file(record_name), document(record_json(results.record, files)));
  if (crate_date) write_crate(out, crate_run_of(results.record, *crate_date));
  return out.commit();
}

std::optional<StudyRecord> read_study_record(const fs::path& folder) {
  const Recording none(nullptr);
  try {
    const Json json = parsed_json(read_whole_file(folder / record_name));
    if (json.at("format") != format_version) return std::nullopt;
    for (const auto& [name, digest] : json.at("files").items())
      if (digest_json(digest_of(read_whole_file(folder / name))) != digest) return std::nullopt;
    return record_of(json);
  } catch (const FileError&) {
    return std::nullopt;
  } catch (const Json::exception&) {
    return std::nullopt;
  }
}

StudyResults read_study(const fs::path& folder) {
  const std::optional<StudyRecord> record = read_study_record(folder);
  if (!record) throw FileError(fmt::format("{}: is not whole: run it again", folder.string()));
  return {*record,
          read_table(folder / "columns.csv"),
          {read_table(folder / "limits.csv"), read_table(folder / "hips.csv"),
           read_table(folder / "failures.csv")}};
}

}  // namespace condyle::io
