#include "io/sweep/sweep_files.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>
#include <tuple>

#include "condyle/error.hpp"
#include "condyle/io/mesh_file.hpp"
#include "condyle/version.hpp"
#include "io/file/output_folder.hpp"
#include "io/file/whole_file.hpp"
#include "io/result/provenance_forms.hpp"
#include "io/study/json_digest.hpp"
#include "io/study/study_files.hpp"
#include "io/study/study_inputs.hpp"

namespace condyle::io {
namespace {

namespace fs = std::filesystem;

bool is_of_sweep(std::string_view name) {
  return name == "sweep.json" || name == "designs.csv" || name == "safe.csv" || name == "zone.vtp";
}

std::string digest_text(std::string_view bytes) {
  return digest_of(bytes).sha256;
}

/// Parameters with more than one value.
std::vector<std::size_t> axes_of(const SweepAnswer& sweep) {
  std::vector<std::size_t> axes;
  for (std::size_t p = 0; p < sweep.parameters.size(); ++p)
    if (sweep.parameters[p].count() > 1) axes.push_back(p);
  return axes;
}

/// A sheet over two parameters, one unit of each a millimetre: its vertices are the designs.
TriMesh sheet_of(const SweepAnswer& sweep, const std::vector<std::size_t>& axes) {
  TriMesh sheet;
  for (std::size_t i = 0; i < sweep.designs(); ++i) {
    const std::vector<double> values = sweep.values_of(sweep.first_design + i);
    sheet.vertices.push_back({values[axes[0]], values[axes[1]], 0});
  }
  const std::size_t length = sweep.parameters[axes[1]].count(), lines = sweep.designs() / length;
  for (std::size_t line = 0; line + 1 < lines; ++line)
    for (std::size_t k = 0; k + 1 < length; ++k) {
      const auto a = static_cast<Index>(line * length + k), b = a + static_cast<Index>(length);
      sheet.triangles.push_back({a, b, a + 1});
      sheet.triangles.push_back({a + 1, b, b + 1});
    }
  return sheet;
}

/// Without provenance, which sweep.json beside it has: bytes that do not depend on how the sweep was shared.
void write_zone(const fs::path& path, const SweepResult& result) {
  const SweepAnswer& sweep = result.answer;
  std::vector<MeshArray> arrays{{"margin_deg", sweep.margin_deg}};
  if (!sweep.probability.empty()) arrays.push_back({"probability", sweep.probability});
  for (std::size_t q = 0; q < sweep.quantity_names.size(); ++q) {
    std::vector<double> values;
    for (std::size_t i = 0; i < sweep.designs(); ++i)
      values.push_back(sweep.quantities[i * sweep.quantity_names.size() + q]);
    arrays.push_back({sweep.quantity_names[q], std::move(values)});
  }
  for (std::size_t t = 0; t < sweep.targets.size(); ++t) {
    std::vector<double> limits;
    for (std::size_t i = 0; i < sweep.designs(); ++i)
      limits.push_back(sweep.limits[i * sweep.targets.size() + t].turned_deg);
    arrays.push_back({fmt::format("{}_limit_deg", sweep.targets[t].name), std::move(limits)});
  }
  write_vtp(path, sheet_of(sweep, axes_of(sweep)), arrays, {}, {VtpEncoding::binary, {}});
}

struct SweepTexts {
  Json json;
  std::string designs, safe;
};

/// The files of a sweep, if they are those that sweep.json was written with. They are no inputs: the next run writes over them.
std::optional<SweepTexts> texts_in(const fs::path& folder) {
  const Recording none(nullptr);
  try {
    SweepTexts texts{Json::parse(read_whole_file(folder / "sweep.json")),
                     read_whole_file(folder / "designs.csv"), read_whole_file(folder / "safe.csv")};
    if (texts.json.at("files").at("designs.csv").get<std::string>() != digest_text(texts.designs) ||
        texts.json.at("files").at("safe.csv").get<std::string>() != digest_text(texts.safe))
      return std::nullopt;
    for (const char* named : {"family", "provenance", "read", "share"}) texts.json.at(named);
    return texts;
  } catch (const FileError&) {
    return std::nullopt;
  } catch (const nlohmann::json::exception&) {
    return std::nullopt;
  }
}

/// The words of the command without its share.
std::vector<std::string> without_shard(std::span<const std::string> command) {
  std::vector<std::string> words;
  for (std::size_t i = 0; i < command.size(); ++i) {
    if (command[i] == "--shard")
      ++i;
    else
      words.push_back(command[i]);
  }
  return words;
}

void leave_out_shard(Json& provenance) {
  if (provenance.is_null()) return;
  provenance["command"] = without_shard(provenance.at("command").get<std::vector<std::string>>());
}

std::vector<Input> inputs_of(const Json& json) {
  std::vector<Input> inputs;
  for (const Json& text : json.at("read"))
    if (auto input = input_in(text.get_ref<const std::string&>())) inputs.push_back(*std::move(input));
  return inputs;
}

bool is_share(const Json& json, const SweepShare& share) {
  return json.at("share").at("number") == share.number && json.at("share").at("of") == share.of;
}

/// Throws FileError for a share that was copied or renamed, or is of another version.
void check_is_of_folder(const Json& json, const SweepShare& named, const fs::path& folder) {
  const std::string file = (folder / "sweep.json").string();
  const Json& share = json.at("share");
  if (!is_share(json, named))
    throw FileError(
        fmt::format("{}: is of shard {} of {}, in the folder of shard {} of {}: run that shard again", file,
                    share.at("number").dump(), share.at("of").dump(), named.number, named.of));
  const Json& from = json.at("provenance");
  if (!from.is_null() && from.at("version") != version)
    throw FileError(fmt::format("{}: is of version {}, and this is {}: run the shard again", file,
                                from.at("version").get<std::string>(), version));
}

/// Data common to all shares of one sweep.
Json common_to_shares(const Json& json) {
  Json common;
  for (const char* key :
       {"condyle", "joint", "parameters", "targets", "ending_pairs", "band", "family", "read"})
    common[key] = json.at(key);
  return common;
}

}  // namespace

fs::path sweep_folder(const fs::path& folder, const SweepShare& share) {
  return share.of == 1 ? folder : shard_folder(folder, {share.number, share.of});
}

void check_sweep_folder(const fs::path& folder, const Provenance* from) {
  OutputFolder{folder, is_of_sweep, files_read(from)};
}

SweepKey sweep_key(std::string_view options, std::vector<Input> inputs) {
  std::vector<std::string> read;
  for (const Input& input : inputs) read.push_back(text_of(input));
  return {sha256_of({std::string(options), read}), std::move(inputs)};
}

std::string sweep_options(std::span<const std::string> command, std::span<const Input> inputs) {
  std::vector<std::string> words = without_shard(command);
  for (std::string& word : words)
    for (const Input& input : inputs)
      if (input.kind == Input::Kind::file && input.path == word) word = input.state;
  std::erase(words, "--strict");  // decides whether there is an answer, and not which
  return sha256_of({std::string(version), words});
}

std::vector<Input> sweep_inputs(const InputRecorder& read) {
  std::vector<Input> inputs = read.inputs();
  std::sort(inputs.begin(), inputs.end(), [](const Input& a, const Input& b) {
    return std::tie(a.path, a.kind) < std::tie(b.path, b.kind);
  });
  return inputs;
}

std::optional<SweepResult> sweep_there(const fs::path& folder, std::string_view options,
                                       const SweepShare& share) {
  const auto texts = texts_in(folder);
  if (!texts || !is_share(texts->json, share)) return std::nullopt;
  std::vector<Input> inputs = inputs_of(texts->json);
  for (Input& input : inputs) input.state = state_now(input.kind, input.path);
  if (texts->json.at("family") != sweep_key(options, std::move(inputs)).family) return std::nullopt;
  return read_sweep_result(texts->json, texts->designs, texts->safe, folder.string());
}

std::vector<fs::path> write_sweep(const fs::path& folder, const SweepResult& result, const SweepKey& key,
                                  const Provenance* from) {
  OutputFolder out(folder, is_of_sweep, files_read(from), "sweep.json");
  const std::string designs = designs_csv(result), safe = safe_csv(result);
  write_whole_file(out.file("designs.csv"), designs);
  write_whole_file(out.file("safe.csv"), safe);
  const std::vector<std::size_t> axes = axes_of(result.answer);
  if (axes.size() == 2 && result.answer.designs() / result.answer.parameters[axes[1]].count() > 1)
    write_zone(out.file("zone.vtp"), result);
  Json json = sweep_object(result);
  json["family"] = key.family;
  json["read"] = Json::array();
  for (const Input& input : key.inputs) json["read"].push_back(text_of(input));
  json["files"] = {{"designs.csv", digest_text(designs)}, {"safe.csv", digest_text(safe)}};
  // Last: what a run finds there says that the others are whole.
  write_whole_file(out.file("sweep.json"), document(json));
  return out.commit();
}

bool has_sweep_shards(const fs::path& folder) {
  for (const std::size_t of : shard_counts(folder))
    for (std::size_t number = 1; number <= of; ++number) {
      std::error_code ignored;
      if (fs::exists(sweep_folder(folder, {number, of}) / "sweep.json", ignored)) return true;
    }
  return false;
}

MergedSweep merge_sweep(const fs::path& folder) {
  const std::set<std::size_t> counts = shard_counts(folder);
  if (counts.size() != 1)
    throw FileError(fmt::format("{}: shards of {} lie there: remove those of other runs",
                                (folder / "shards").string(), fmt::join(counts, " and of ")));
  const std::size_t of = *counts.begin();
  std::vector<SweepAnswer> shares;
  std::vector<std::size_t> missing;
  std::optional<SweepResult> first;
  Json common;
  for (std::size_t number = 1; number <= of; ++number) {
    const fs::path shard = sweep_folder(folder, {number, of});
    const auto texts = texts_in(shard);
    if (!texts) {
      missing.push_back(number);
      continue;
    }
    if (!missing.empty()) continue;
    check_is_of_folder(texts->json, {number, of}, shard);
    SweepResult result = read_sweep_result(texts->json, texts->designs, texts->safe, shard.string());
    if (!first)
      common = common_to_shares(texts->json);
    else if (common_to_shares(texts->json) != common)
      throw FileError(fmt::format(
          "{}: is of another joint, other targets, options or another version than shard 1", shard.string()));
    shares.push_back(result.answer);
    if (!first) first = std::move(result);
  }
  if (!missing.empty())
    throw FileError(fmt::format("{}: {} of {} shards {} missing or not whole: {}", folder.string(),
                                missing.size(), of, missing.size() == 1 ? "is" : "are",
                                fmt::join(missing, ", ")));
  first->answer = merged_sweep(shares);
  leave_out_shard(first->provenance);
  const SweepKey key{common.at("family").get<std::string>(), inputs_of(common)};
  check_unchanged(key.inputs, {}, sweep_folder(folder, {1, of}).string());
  std::vector<fs::path> written = write_sweep(folder, *first, key, nullptr);
  return {std::move(*first), std::move(written)};
}

}  // namespace condyle::io
