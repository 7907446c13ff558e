#include "baseline.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>

#include "io/file/whole_file.hpp"

namespace bench {

Ratios ratios_of(const ExperimentResult& result) {
  Ratios ratios;
  for (const Outcome& o : result.outcomes) {
    if (o.ours_seconds <= 0) continue;
    ratios[fmt::format("{}/{}/{}", name_of(o.question), o.scene, o.method)] = o.query.mean / o.ours_seconds;
  }
  return ratios;
}

std::string baseline_text(const Ratios& ratios) {
  std::string out = "{";
  for (const auto& [name, ratio] : ratios)
    out += fmt::format("{}\n \"{}\": {:.4g}", out == "{" ? "" : ",", name, ratio);
  return out + "\n}\n";
}

Ratios read_baseline(const std::string& file) {
  std::ifstream in(file);
  if (!in) throw std::runtime_error(file + ": cannot be read");
  try {
    return nlohmann::json::parse(in).get<Ratios>();
  } catch (const nlohmann::json::exception& error) {
    throw std::runtime_error(fmt::format("{}: no baseline of ratios: {}", file, error.what()));
  }
}

namespace {

/// Commands take a second and are measured in processor time: what changes them by a tenth is no noise.
constexpr double tolerated_of_commands = 0.9;

bool is_of_command(std::string_view name) {
  return name.starts_with(command_ratios);
}

std::string line_of(const std::string& name, double now, double before) {
  if (is_of_command(name))
    return fmt::format("{}: {:.3g} times as long as inspect, was {:.3g}", name, 1 / now, 1 / before);
  return fmt::format("{}: {:.3g} times Condyle's time, was {:.3g}", name, now, before);
}

}  // namespace

std::vector<std::string> worse_than(const Ratios& baseline, const Ratios& now, double tolerated) {
  std::vector<std::pair<double, std::string>> worse;
  for (const auto& [name, before] : baseline) {
    const auto at = now.find(name);
    if (at == now.end()) continue;
    const double part = at->second / before;
    if (part < (is_of_command(name) ? tolerated_of_commands : tolerated))
      worse.emplace_back(part, line_of(name, at->second, before));
  }
  std::sort(worse.begin(), worse.end());
  std::vector<std::string> lines;
  for (auto& [part, line] : worse) lines.push_back(std::move(line));
  return lines;
}

std::span<const std::string_view> main_ratios() {
  static constexpr std::array<std::string_view, 8> names = {
      "inside/hip_vhf_right/embree_16_culled", "pairs/hip_vhf_right/fcl_obbrss",
      "touch/hip_vhf_right/fcl_obbrss",        "first_contact/sample_3/fcl_obbrss_bisected_with_building",
      "deepest/hip_vhf_right/cgal_tree",       "first_contact/hip_vhf_right/fcl_obbrss_bisected",
      "map/hip_vhf_right/fcl_obbrss_bisected", "depth/hip_vhf_right/cgal_tree",
  };
  return names;
}

void add_run(const std::string& file, const Report& report, const Ratios& ratios) {
  using json = nlohmann::ordered_json;
  json runs = json::array();
  if (std::ifstream in(file); in) runs = json::parse(in, nullptr, false);
  if (!runs.is_array()) throw std::runtime_error(file + ": no file of stored runs");
  json run;
  for (const auto& [name, words] : report.machine)
    if (name == "date" || name == "commit" || name == "processor" || name == "load") run[name] = words;
  run["ratios"] = json::object();
  for (const std::string_view name : main_ratios())
    if (const auto at = ratios.find(std::string(name)); at != ratios.end())
      run["ratios"][at->first] = json::parse(fmt::format("{:.4g}", at->second));
  runs.push_back(run);
  // A run a line: a diff shows what was added.
  std::string text = "[";
  for (const json& each : runs) text += (text == "[" ? "\n " : ",\n ") + each.dump();
  condyle::io::write_whole_file(file, text + "\n]\n");
}

}  // namespace bench
