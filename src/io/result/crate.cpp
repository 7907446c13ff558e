#include "io/result/crate.hpp"

#include <fmt/format.h>

#include <array>
#include <chrono>
#include <map>
#include <utility>

#include "condyle/error.hpp"
#include "condyle/io/provenance.hpp"
#include "condyle/version.hpp"
#include "io/file/in_quotes.hpp"
#include "io/file/input_file.hpp"
#include "io/file/output_folder.hpp"
#include "io/file/whole_file.hpp"
#include "io/mesh/parse.hpp"
#include "io/result/json.hpp"
#include "io/result/provenance_forms.hpp"
#include "io/result/scope_text.hpp"

namespace condyle::io {
namespace {

namespace fs = std::filesystem;

constexpr const char* profile = "https://w3id.org/ro/wfrun/process/0.5";

Json reference(const std::string& id) {
  return {{"@id", id}};
}

Json references(const std::vector<Json>& entities) {
  Json list = Json::array();
  for (const Json& entity : entities) list.push_back(reference(entity.at("@id")));
  return list;
}

/// The path as a relative URI: RFC 3986, section 2.3.
std::string uri_of(const fs::path& file) {
  std::string uri;
  for (const char c : file.generic_string()) {
    const bool is_plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                          std::string_view("-._~/").find(c) != std::string_view::npos;
    uri += is_plain ? std::string(1, c) : fmt::format("%{:02X}", static_cast<unsigned char>(c));
  }
  return uri;
}

void add_media_type(Json& entity, const fs::path& file) {
  static constexpr std::array types{
      std::pair{".csv", "text/csv"},        std::pair{".h5", "application/x-hdf5"},
      std::pair{".html", "text/html"},      std::pair{".json", "application/json"},
      std::pair{".pdf", "application/pdf"}, std::pair{".png", "image/png"},
      std::pair{".svg", "image/svg+xml"},   std::pair{".toml", "application/toml"}};
  for (const auto& [ending, type] : types)
    if (file.extension() == ending) entity["encodingFormat"] = type;
}

std::vector<Json> results_in(const fs::path& folder, std::span<const fs::path> files) {
  const Recording none(nullptr);  // results are no inputs
  std::vector<Json> results;
  for (const fs::path& file : files) {
    Json& entity = results.emplace_back(Json{{"@id", uri_of(file)},
                                             {"@type", "File"},
                                             {"name", file.filename().string()},
                                             {"contentSize", fmt::format("{}", size_of_file(folder / file))},
                                             {"sha256", state_now(Input::Kind::file, folder / file)}});
    add_media_type(entity, file);
  }
  return results;
}

/// Inputs lie outside the crate, and where they lie holds for one machine only: their identifiers are of their contents, RFC 6920,
/// section 7. Files of the same contents are one entity with several names.
std::vector<Json> entities_of(const std::vector<Input>& inputs) {
  std::vector<Json> entities;
  std::map<std::string, std::size_t> places;
  for (const Input& input : inputs) {
    if (input.kind != Input::Kind::file || !is_digest(input.state)) continue;
    const auto [place, is_new] = places.emplace(input.state, entities.size());
    if (is_new)
      entities.push_back({{"@id", "nih:sha-256;" + input.state},
                          {"@type", "File"},
                          {"name", input.path.filename().string()},
                          {"alternateName", Json::array()},
                          {"sha256", input.state}});
    entities[place->second]["alternateName"].push_back(input.path.string());
  }
  return entities;
}

}  // namespace

void check_crate_date(std::string_view date) {
  unsigned year = 0, month = 0, day = 0;
  const bool has_form = date.size() == 10 && date[4] == '-' && date[7] == '-' &&
                        date.find_first_not_of("0123456789-") == date.npos;
  if (has_form && parse_number(date.substr(0, 4), year) && parse_number(date.substr(5, 2), month) &&
      parse_number(date.substr(8), day) &&
      (std::chrono::year(static_cast<int>(year)) / std::chrono::month(month) / std::chrono::day(day)).ok())
    return;
  throw UsageError(fmt::format("crate: {} is no day, such as 2026-01-31", in_quotes(date)));
}

std::string crate_document(const CrateRun& run, const fs::path& folder, std::span<const fs::path> files) {
  const std::vector<Json> results = results_in(folder, files), inputs = entities_of(run.inputs);
  std::vector<Json> parts = results;
  parts.insert(parts.end(), inputs.begin(), inputs.end());
  Json graph = Json::array();
  graph.push_back({{"@id", crate_name},
                   {"@type", "CreativeWork"},
                   {"conformsTo", reference("https://w3id.org/ro/crate/1.1")},
                   {"about", reference("./")}});
  graph.push_back({{"@id", "./"},
                   {"@type", "Dataset"},
                   {"name", "Results of " + run.name},
                   {"description", "Written by " + run.name + ": " + scope_text()},
                   {"datePublished", run.date},
                   {"license", reference("#licence")},
                   {"conformsTo", reference(profile)},
                   {"hasPart", references(parts)},
                   {"mentions", reference("#run")}});
  graph.push_back(
      {{"@id", profile}, {"@type", "CreativeWork"}, {"name", "Process Run Crate"}, {"version", "0.5"}});
  graph.push_back({{"@id", "#licence"},
                   {"@type", "CreativeWork"},
                   {"name", "No licence stated"},
                   {"description", "Results are under the terms of the files that they come from."}});
  graph.push_back({{"@id", "#condyle"},
                   {"@type", "SoftwareApplication"},
                   {"name", "Condyle"},
                   {"softwareVersion", std::string(version)},
                   {"license", reference("https://www.apache.org/licenses/LICENSE-2.0")}});
  graph.push_back({{"@id", "https://www.apache.org/licenses/LICENSE-2.0"},
                   {"@type", "CreativeWork"},
                   {"name", "Apache License 2.0"}});
  graph.push_back({{"@id", "#run"},
                   {"@type", "CreateAction"},
                   {"name", run.name},
                   {"description", run.description},
                   {"instrument", reference("#condyle")},
                   {"object", references(inputs)},
                   {"result", references(results)}});
  for (Json& part : parts) graph.push_back(std::move(part));
  Json crate;
  crate["@context"] = {"https://w3id.org/ro/crate/1.1/context",
                       "https://w3id.org/ro/terms/workflow-run/context"};
  crate["@graph"] = std::move(graph);
  return document(std::move(crate));
}

void write_crate(OutputFolder& out, const CrateRun& run) {
  const std::string text = crate_document(run, out.aside(), out.names());
  write_whole_file(out.file(crate_name), text);
}

CrateRun crate_run_of(const Provenance& from, std::string date, std::string name) {
  CrateRun run{std::move(date), std::move(name), command_text(from.command), {}};
  const auto add = [&](const fs::path& path, const std::string& sha256) {
    run.inputs.push_back({Input::Kind::file, path, sha256});
  };
  add(from.joint_path, from.joint_digest.sha256);
  for (const MeshOrigin* body : {&from.fixed, &from.mobile})
    for (const MeshSource& mesh : body->files) add(mesh.path, mesh.digest.sha256);
  for (const OtherFile& file : from.other_files) add(file.path, file.sha256);
  return run;
}

}  // namespace condyle::io
