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

std::vector<std::string> worse_than(const Ratios& baseline, const Ratios& now, double tolerated) {
  std::vector<std::pair<double, std::string>> worse;
  for (const auto& [name, before] : baseline) {
    const auto at = now.find(name);
    if (at == now.end()) continue;
    const double part = at->second / before;
    if (part < tolerated)
      worse.emplace_back(
          part, fmt::format("{}: {:.3g} times Condyle's time, was {:.3g}", name, at->second, before));
  }
  std::sort(worse.begin(), worse.end());
  std::vector<std::string> lines;
  for (auto& [part, line] : worse) lines.push_back(std::move(line));
  return lines;
}

}  // namespace bench
