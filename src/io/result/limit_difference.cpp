#include "io/result/limit_difference.hpp"

#include <algorithm>
#include <cassert>
#include <cstddef>

#include "motion/rom/displacement.hpp"

namespace condyle::io {
namespace {

bool are_paired(const motion::BandOptions& a, const motion::BandOptions& b) noexcept {
  return a.seed == b.seed && a.samples == b.samples;
}

DifferenceBand difference_band(const motion::LimitBand& before, const motion::LimitBand& after) {
  std::vector<double> differences;
  for (std::size_t i = 0; i < after.turned.size(); ++i)
    differences.push_back(after.turned[i].degrees() - before.turned[i].degrees());
  std::sort(differences.begin(), differences.end());
  return {motion::quantile(differences, 0.05), motion::quantile(differences, 0.5),
          motion::quantile(differences, 0.95)};
}

/// Without its band.
LimitDifference limit_difference(const motion::MotionLimit& before, const motion::MotionLimit& after) {
  LimitDifference difference{.motion = after.motion.name};
  const auto ends_by = [&](motion::LimitReason of_before, motion::LimitReason of_after) {
    return before.end.reason == of_before && after.end.reason == of_after;
  };
  if (ends_by(motion::LimitReason::contact, motion::LimitReason::contact))
    difference.is = DifferenceIs::exact;
  else if (ends_by(motion::LimitReason::contact, motion::LimitReason::end_of_range))
    difference.is = DifferenceIs::at_least;
  else if (ends_by(motion::LimitReason::end_of_range, motion::LimitReason::contact))
    difference.is = DifferenceIs::at_most;
  else
    return difference;
  difference.by_deg = after.end.turned.degrees() - before.end.turned.degrees();
  return difference;
}

Json band_json_of(const std::optional<DifferenceBand>& band) {
  if (!band) return nullptr;
  return {{"p5_deg", band->p5_deg}, {"median_deg", band->median_deg}, {"p95_deg", band->p95_deg}};
}

}  // namespace

std::vector<LimitDifference> limit_differences(const RangeAnswer& before, const RangeAnswer& after) {
  assert(before.limits.size() == after.limits.size());
  const bool have_bands =
      !before.bands.empty() && !after.bands.empty() && are_paired(before.band_options, after.band_options);
  std::vector<LimitDifference> differences;
  for (std::size_t i = 0; i < after.limits.size(); ++i) {
    differences.push_back(limit_difference(before.limits[i], after.limits[i]));
    if (have_bands && differences.back().by_deg)
      differences.back().band = difference_band(before.bands[i], after.bands[i]);
  }
  return differences;
}

Json differences_json(const std::vector<LimitDifference>& differences) {
  static constexpr std::string_view words[] = {"exact", "at_least", "at_most"};
  Json json = Json::array();
  for (const LimitDifference& each : differences)
    json.push_back(
        {{"motion", each.motion},
         {"difference_deg", nullable(each.by_deg)},
         {"difference_is", each.by_deg ? Json(words[static_cast<std::size_t>(each.is)]) : Json(nullptr)},
         {"band", band_json_of(each.band)},
         {"beyond_band", each.band ? Json(each.band->leaves_out_zero()) : Json(nullptr)}});
  return json;
}

}  // namespace condyle::io
