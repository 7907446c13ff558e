#include "io/report/sweep_block.hpp"

#include <cstdint>
#include <span>
#include <vector>

#include "answer/sweep_summary.hpp"
#include "condyle/error.hpp"
#include "io/report/report.hpp"

namespace condyle::io {

void check_shown_sweep(std::span<const plan::SweptParameter> parameters, std::size_t targets) {
  constexpr std::size_t most_targets = 255, most_cells = 10'000;
  if (parameters.size() > 2) throw UsageError("a page shows a sweep over one or two parameters");
  if (targets > most_targets) throw UsageError("a page shows a sweep of up to 255 targets");
  if (designs_of(parameters) > most_cells) throw UsageError("a page shows a sweep of up to 10000 designs");
}

namespace {

/// The target with the smallest margin for each design; the first of equal ones.
std::vector<std::uint8_t> least_of(const SweepAnswer& sweep) {
  std::vector<std::uint8_t> least;
  const std::size_t width = sweep.targets.size();
  for (std::size_t i = 0; i < sweep.designs(); ++i) {
    const auto limits = std::span(sweep.limits).subspan(i * width, width);
    least.push_back(static_cast<std::uint8_t>(answer::least_target(sweep.targets, limits)));
  }
  return least;
}

Json target_or_null(const std::optional<std::size_t>& target) {
  return target ? Json(*target) : Json(nullptr);
}

}  // namespace

Json sweep_block(const SweepResult& sweep, BlockArrays& arrays) {
  Json json = sweep_object(sweep);
  for (const char* key :
       {"condyle", "joint", "anatomy", "side", "share", "first_design", "notes", "scope", "provenance"})
    json.erase(key);
  json["margin_deg"] = arrays.add("sweep_margins", sweep.answer.margin_deg);
  json["least_target"] = arrays.add("sweep_least", least_of(sweep.answer));
  Json safe = Json::array();
  for (const plan::SafeInterval& each : sweep.answer.safe)
    safe.push_back({{"line", each.line},
                    {"low", each.low},
                    {"high", each.high},
                    {"low_target", target_or_null(each.low_target)},
                    {"high_target", target_or_null(each.high_target)}});
  json["safe"] = std::move(safe);
  return json;
}

}  // namespace condyle::io
