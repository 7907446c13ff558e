#include "baseline.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>

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

}  // namespace bench
