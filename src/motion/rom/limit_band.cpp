#include "condyle/limit_band.hpp"

#include <algorithm>
#include <mutex>

#include "core/parallel.hpp"
#include "motion/rom/displaced_joint.hpp"
#include "motion/rom/displacement.hpp"

namespace condyle::motion {
namespace {

using motion::Displacement;
using motion::quantile;

enum class Source { all, centre, axes, surface, parameters };

bool moves_surface(const Uncertainty& sigma, const Joint& joint) {
  return sigma.surface_mm > 0 || sigma.is_by_voxels(joint.fixed) || sigma.is_by_voxels(joint.mobile);
}

/// The sources to compute: all of them together, and each one by itself if there are several.
std::vector<Source> sources_of(const Uncertainty& sigma, const Joint& joint) {
  std::vector<Source> moving;
  if (sigma.centre_mm > 0) moving.push_back(Source::centre);
  if (sigma.axes > Angle()) moving.push_back(Source::axes);
  if (moves_surface(sigma, joint)) moving.push_back(Source::surface);
  if (kinematics::uncertain_parameters(joint) > 0) moving.push_back(Source::parameters);
  if (moving.size() < 2) return {Source::all};
  moving.insert(moving.begin(), Source::all);
  return moving;
}

bool moves(const Uncertainty& sigma, const Joint& joint, Source source) {
  return source == Source::centre       ? sigma.centre_mm > 0
         : source == Source::axes       ? sigma.axes > Angle()
         : source == Source::parameters ? kinematics::uncertain_parameters(joint) > 0
                                        : moves_surface(sigma, joint);
}

/// Only the part of the displacement that one source moves.
Displacement only(Source source, Displacement d) {
  if (source == Source::all) return d;
  if (source != Source::centre) d.centre.setZero();
  if (source != Source::axes) d.axes.setZero();
  if (source != Source::parameters) d.parameters.clear();
  if (source != Source::surface) d.fixed_surface = d.mobile_surface = 0;
  return d;
}

void check(const BandOptions& options, std::span<const Motion> motions, JointKind kind) {
  motion::check_band(options);
  for (const Motion& motion : motions) check_motion(motion, kind);
}

/// The bands of all these sources together, the first, with the widths of those that are among them by themselves.
std::optional<std::vector<LimitBand>> bands_of(const Joint& joint, std::span<const Motion> motions,
                                               const RangeOptions& range, const BandOptions& options,
                                               const std::vector<Source>& sources, const Control& control) {
  check(options, motions, joint.kind);
  DisplacedJoint displaced(joint, motions, range, options.sigma);
  displaced.learn();
  const std::vector<Displacement> samples =
      motion::displacements(options, kinematics::uncertain_parameters(joint));

  // Outcomes by source, sample and motion.
  const std::size_t count = samples.size(), width = motions.size(), total = sources.size() * count;
  std::vector<DisplacedLimit> outcomes(total * width);
  std::size_t done = 0;
  std::mutex reporting;
  core::parallel_chunks(total, 1, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last && !control.stop.stop_requested(); ++i) {
      displaced.limits(only(sources[i / count], samples[i % count]),
                       std::span(outcomes).subspan(i * width, width));
      const std::scoped_lock lock(reporting);
      ++done;
      if (control.progress) control.progress("joints of the band", done, total);
    }
  });
  if (done < total) return std::nullopt;

  std::vector<LimitBand> bands;
  for (std::size_t m = 0; m < width; ++m) {
    const auto turned = [&](std::size_t source, std::size_t sample) {
      return outcomes[(source * count + sample) * width + m].turned;
    };
    const auto sorted = [&](std::size_t source) {
      std::vector<double> values;
      for (std::size_t i = 0; i < count; ++i) values.push_back(turned(source, i).radians());
      std::sort(values.begin(), values.end());
      return values;
    };
    const auto width_of = [&](Source source) {
      if (!moves(options.sigma, joint, source)) return Angle();
      // Where it is the only one, all of it is its own.
      const auto at = std::find(sources.begin(), sources.end(), source);
      const auto values = sorted(at == sources.end() ? 0 : static_cast<std::size_t>(at - sources.begin()));
      return Angle::radians(quantile(values, 0.95) - quantile(values, 0.05));
    };
    const auto share = [&](LimitReason reason) {
      std::size_t with = 0;
      for (std::size_t i = 0; i < count; ++i) with += outcomes[i * width + m].reason == reason;
      return static_cast<double>(with) / static_cast<double>(count);
    };
    const auto all = sorted(0);
    bands.push_back({Angle::radians(quantile(all, 0.05)),
                     Angle::radians(quantile(all, 0.5)),
                     Angle::radians(quantile(all, 0.95)),
                     {width_of(Source::centre), width_of(Source::axes), width_of(Source::surface),
                      width_of(Source::parameters)},
                     share(LimitReason::end_of_range),
                     share(LimitReason::contact_at_start)});
    for (std::size_t i = 0; i < count; ++i) bands.back().turned.push_back(turned(0, i));
  }
  return bands;
}

}  // namespace

std::optional<std::vector<LimitBand>> limit_bands(const Joint& joint, std::span<const Motion> motions,
                                                  const RangeOptions& range, const BandOptions& options,
                                                  const Control& control) {
  return bands_of(joint, motions, range, options, sources_of(options.sigma, joint), control);
}

std::optional<std::vector<LimitBand>> bands_without_widths(const Joint& joint,
                                                           std::span<const Motion> motions,
                                                           const RangeOptions& range,
                                                           const BandOptions& options,
                                                           const Control& control) {
  return bands_of(joint, motions, range, options, {Source::all}, control);
}

std::vector<LimitBand> limit_bands(const Joint& joint, std::span<const Motion> motions,
                                   const RangeOptions& range, const BandOptions& options) {
  return *limit_bands(joint, motions, range, options, {});
}

}  // namespace condyle::motion
