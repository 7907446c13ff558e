#include "io/sweep/sweep_files.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

#include "condyle/error.hpp"
#include "condyle/io/mesh_file.hpp"
#include "condyle/version.hpp"
#include "io/file/output_folder.hpp"
#include "io/file/whole_file.hpp"
#include "io/joint/given_degrees.hpp"
#include "io/mesh/parse.hpp"
#include "io/result/provenance_forms.hpp"
#include "io/study/json_digest.hpp"

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

/// The files of a sweep, if they are those that sweep.json was written with.
std::optional<SweepTexts> texts_in(const fs::path& folder) {
  try {
    SweepTexts texts{Json::parse(read_whole_file(folder / "sweep.json")),
                     read_whole_file(folder / "designs.csv"), read_whole_file(folder / "safe.csv")};
    if (texts.json.at("files").at("designs.csv").get<std::string>() != digest_text(texts.designs) ||
        texts.json.at("files").at("safe.csv").get<std::string>() != digest_text(texts.safe))
      return std::nullopt;
    return texts;
  } catch (const FileError&) {
    return std::nullopt;
  } catch (const nlohmann::json::exception&) {
    return std::nullopt;
  }
}

/// Into how many shares the sweep was parted, by the names of their folders.
std::set<std::size_t> counts_in(const fs::path& folder) {
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

/// The words of the command without its share.
void leave_out_shard(Json& provenance) {
  if (provenance.is_null()) return;
  Json words = Json::array();
  const Json& given = provenance.at("command");
  for (std::size_t i = 0; i < given.size(); ++i) {
    if (given[i] == "--shard")
      ++i;
    else
      words.push_back(given[i]);
  }
  provenance["command"] = std::move(words);
}

/// Data common to all shares of one sweep.
Json common_to_shares(const Json& json) {
  Json common;
  for (const char* key : {"condyle", "joint", "parameters", "targets", "ending_pairs", "band", "family"})
    common[key] = json.at(key);
  return common;
}

}  // namespace

fs::path sweep_folder(const fs::path& folder, const SweepShare& share) {
  return share.of == 1 ? folder : folder / "shards" / fmt::format("{}_of_{}", share.number, share.of);
}

void check_sweep_folder(const fs::path& folder, const Provenance* from) {
  OutputFolder{folder, is_of_sweep, files_read(from)};
}

std::string sweep_key(const Provenance& from, const SweepQuery& query, std::string_view targets,
                      std::string_view quantities) {
  nlohmann::json all{std::string(version), digest_text(targets), from.joint_digest.sha256,
                     std::string(quantities)};
  for (const MeshOrigin* body : {&from.fixed, &from.mobile})
    for (const MeshSource& mesh : body->files) all.push_back(mesh.digest.sha256);
  for (const PosedPart& part : from.parts)
    for (const PartParameter& parameter : part.parameters) all.push_back(parameter.value);
  for (const plan::SweptParameter& each : query.parameters)
    all.push_back({each.name, each.first, each.last, each.step});
  all.push_back(
      {static_cast<int>(query.range.bearing.rule),
       query.range.bearing.margin_mm ? nlohmann::json(*query.range.bearing.margin_mm) : nlohmann::json(),
       static_cast<int>(query.range.overlap.reference_contact)});
  if (query.bands) all.push_back({query.bands->samples, query.bands->seed});
  return sha256_of(all);
}

std::optional<SweepResult> sweep_there(const fs::path& folder, std::string_view key) {
  const auto texts = texts_in(folder);
  if (!texts || texts->json.value("family", "") != key) return std::nullopt;
  return read_sweep_result(texts->json, texts->designs, texts->safe, folder.string());
}

std::vector<fs::path> write_sweep(const fs::path& folder, const SweepResult& result, std::string_view key,
                                  const Provenance* from) {
  OutputFolder out(folder, is_of_sweep, files_read(from), "sweep.json");
  const std::string designs = designs_csv(result), safe = safe_csv(result);
  write_whole_file(out.file("designs.csv"), designs);
  write_whole_file(out.file("safe.csv"), safe);
  const std::vector<std::size_t> axes = axes_of(result.answer);
  if (axes.size() == 2 && result.answer.designs() / result.answer.parameters[axes[1]].count() > 1)
    write_zone(out.file("zone.vtp"), result);
  Json json = sweep_object(result);
  json["family"] = key;
  json["files"] = {{"designs.csv", digest_text(designs)}, {"safe.csv", digest_text(safe)}};
  // Last: what a run finds there says that the others are whole.
  write_whole_file(out.file("sweep.json"), document(json));
  return out.commit();
}

bool has_sweep_shards(const fs::path& folder) {
  for (const std::size_t of : counts_in(folder))
    for (std::size_t number = 1; number <= of; ++number) {
      std::error_code ignored;
      if (fs::exists(sweep_folder(folder, {number, of}) / "sweep.json", ignored)) return true;
    }
  return false;
}

MergedSweep merge_sweep(const fs::path& folder) {
  const std::set<std::size_t> counts = counts_in(folder);
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
  const std::string key = common.at("family").get<std::string>();
  std::vector<fs::path> written = write_sweep(folder, *first, key, nullptr);
  return {std::move(*first), std::move(written)};
}

}  // namespace condyle::io
