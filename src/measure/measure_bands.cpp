#include <algorithm>
#include <mutex>

#include "core/parallel.hpp"
#include "measure/displaced_bones.hpp"
#include "motion/rom/displacement.hpp"

namespace condyle::measure {
namespace {

/// Hours before 12 come before those after it: a band around 12 is one.
double unwrapped(const MeasureDefinition& definition, double value) {
  return definition.unit == "h" && value >= 6 ? value - 12 : value;
}
double wrapped(const MeasureDefinition& definition, double value) {
  return definition.unit == "h" && value < 0 ? value + 12 : value;
}

MeasureBand band_of(const MeasureDefinition& definition, std::span<const std::optional<double>> outcomes) {
  std::vector<double> values;
  for (const auto& value : outcomes)
    if (value) values.push_back(unwrapped(definition, *value));
  MeasureBand band;
  band.samples_without_value = outcomes.size() - values.size();
  if (values.empty()) return band;
  std::sort(values.begin(), values.end());
  const auto at = [&](double q) { return wrapped(definition, motion::quantile(values, q)); };
  band.p5 = at(0.05), band.median = at(0.5), band.p95 = at(0.95);
  return band;
}

}  // namespace
std::optional<std::vector<MeasureBand>> measure_bands(const Joint& joint, const MeasureOptions& request,
                                                      const motion::BandOptions& options,
                                                      const Control& control) {
  measure::check_measures(joint, request);
  motion::check_band(options);
  const DisplacedBones bones(joint, request, options.sigma);
  const auto samples = motion::displacements(options, kinematics::uncertain_parameters(joint));
  const auto definitions = measure_definitions();

  // Outcomes by measure and sample.
  const std::size_t count = samples.size();
  std::vector<std::optional<double>> outcomes(definitions.size() * count);
  std::size_t done = 0;
  std::mutex reporting;
  core::parallel_chunks(count, 1, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last && !control.stop.stop_requested(); ++i) {
      const HipMeasures measured = bones.measured(samples[i]);
      for (std::size_t m = 0; m < definitions.size(); ++m)
        outcomes[m * count + i] = definitions[m].of(measured).value;
      const std::lock_guard lock(reporting);
      ++done;
      if (control.progress) control.progress("joints of the band", done, count);
    }
  });
  if (done < count) return std::nullopt;
  std::vector<MeasureBand> bands;
  for (std::size_t m = 0; m < definitions.size(); ++m)
    bands.push_back(measure::band_of(definitions[m], std::span(outcomes).subspan(m * count, count)));
  return bands;
}

std::vector<MeasureBand> measure_bands(const Joint& joint, const MeasureOptions& request,
                                       const motion::BandOptions& options) {
  return *measure_bands(joint, request, options, {});
}

}  // namespace condyle::measure
