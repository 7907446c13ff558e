#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "answer/sweep_summary.hpp"
#include "condyle/answer.hpp"
#include "condyle/error.hpp"
#include "core/formatted.hpp"
#include "core/one_line.hpp"
#include "core/parallel.hpp"
#include "motion/rom/displacement.hpp"
#include "plan/design_limits.hpp"

namespace condyle {
namespace {

using core::formatted;

constexpr std::size_t most_parameters = 4;

std::vector<std::string> names_of(std::span<const plan::SweptParameter> parameters) {
  std::vector<std::string> names;
  for (const plan::SweptParameter& each : parameters) names.push_back(each.name);
  return names;
}

/// Names of the parameters that have a standard deviation, in the order of the draws.
std::vector<std::string> uncertain_names(const Joint& joint) {
  std::vector<std::string> names;
  for (const PosedPart& part : joint.posed->parts)
    for (const PartParameter& parameter : part.parameters)
      if (parameter.sigma > 0) names.push_back(part.name + "." + parameter.name);
  return names;
}

const PartParameter& parameter_named(const Joint& joint, const std::string& name) {
  for (const PosedPart& part : joint.posed->parts)
    for (const PartParameter& parameter : part.parameters)
      if (part.name + "." + parameter.name == name) return parameter;
  throw UsageError("there is no parameter " + name);
}

void check_target(const plan::SweepTarget& target, const Joint& joint) {
  const std::string named = "target " + core::one_line(target.name) + ": ";
  try {
    motion::check_motion(target.motion, joint.kind);
  } catch (const UsageError& error) {
    throw UsageError(named + error.what());
  }
  const double reach = target.reach.degrees(), range = target.motion.range.degrees();
  if (!(target.reach > Angle()) || !(target.reach <= target.motion.range))
    throw UsageError(named + formatted("%.10g degrees, must be above 0 and up to the motion's range, %.10g",
                                       reach, range));
  if (!(std::abs(target.pelvic_tilt.degrees()) <= measure::largest_pelvic_tilt_deg))
    throw UsageError(named + formatted("the tilt must be between %g and %g degrees",
                                       -measure::largest_pelvic_tilt_deg, measure::largest_pelvic_tilt_deg));
  if (target.pelvic_tilt.radians() != 0 && !joint.is_hip())
    throw UsageError(named + "a pelvic tilt is of a hip");
  if (!(target.weight > 0))
    throw UsageError(named + formatted("its weight is %g, must be above 0", target.weight));
}

/// Designs that differ in the last parameter only.
struct Lines {
  std::size_t first, count, length;

  Lines(const SweepRequest& request) : length(request.parameters.back().count()) {
    const std::size_t all = designs_of(request.parameters) / length;
    first = (request.share.number - 1) * all / request.share.of;
    count = request.share.number * all / request.share.of - first;
  }
};

/// The sweep of a share, line by line.
class Sweeping {
 public:
  Sweeping(const SweepRequest& request, const plan::DesignLimits& limits, SweepAnswer& answer)
      : request_(request), limits_(limits), answer_(answer), lines_(request) {
    answer.first_design = lines_.first * lines_.length;
    answer.limits.resize(lines_.count * lines_.length * request.targets.size());
    answer.margin_deg.resize(lines_.count * lines_.length);
  }

  /// False if it was stopped.
  bool designs(const Control& control) {
    return each("designs", answer_.designs(), control, [&](std::size_t i) {
      limits_.limits(answer_.values_of(answer_.first_design + i), limits_of(i));
      answer_.margin_deg[i] = answer::least_margin(request_.targets, limits_of(i));
    });
  }

  bool borders(const Control& control) {
    std::vector<std::vector<plan::SafeInterval>> of_line(lines_.count);
    if (!each("borders", lines_.count, control, [&](std::size_t line) { of_line[line] = intervals(line); }))
      return false;
    for (const auto& safe : of_line) answer_.safe.insert(answer_.safe.end(), safe.begin(), safe.end());
    return true;
  }

  bool probabilities(const Joint& joint, const motion::BandOptions& options, const Control& control) {
    std::vector<std::string> names = names_of(request_.parameters);
    const std::vector<std::string> uncertain = uncertain_names(joint);
    // Where each uncertain parameter stands among the values of a design.
    std::vector<std::size_t> place;
    for (const std::string& name : uncertain) {
      const auto known = std::find(names.begin(), names.end(), name);
      place.push_back(static_cast<std::size_t>(known - names.begin()));
      if (known == names.end()) names.push_back(name);
    }
    const plan::DesignLimits displaced(joint, request_.range, request_.targets, names, uses_closed_forms());
    const auto draws = motion::displacements(options, uncertain.size());
    answer_.probability.resize(answer_.designs());
    return each("displaced designs", answer_.designs(), control, [&](std::size_t i) {
      std::vector<double> given = answer_.values_of(answer_.first_design + i);
      for (std::size_t k = given.size(); k < names.size(); ++k)
        given.push_back(parameter_named(joint, names[k]).value);
      std::size_t safe = 0;
      for (const motion::Displacement& draw : draws) {
        std::vector<double> values = given;
        for (std::size_t u = 0; u < uncertain.size(); ++u)
          values[place[u]] += parameter_named(joint, uncertain[u]).sigma * draw.parameters[u];
        safe += displaced.reaches_all(values);
      }
      answer_.probability[i] = static_cast<double>(safe) / static_cast<double>(draws.size());
    });
  }

  bool quantities(const Joint& joint, const Control& control) {
    const std::vector<std::string> names = names_of(request_.parameters);
    for (const SweepQuantities& each : request_.quantities)
      answer_.quantity_names.insert(answer_.quantity_names.end(), each.names.begin(), each.names.end());
    const std::size_t width = answer_.quantity_names.size();
    const auto of_values = [&](std::span<const double> values) {
      std::vector<ParameterValue> named;
      for (std::size_t p = 0; p < names.size(); ++p) named.push_back({names[p], values[p]});
      const Joint design = with_parameters(joint, named);
      std::vector<double> found;
      for (const SweepQuantities& quantities : request_.quantities) {
        const std::vector<double> of = quantities.of(design);
        found.insert(found.end(), of.begin(), of.end());
      }
      return found;
    };
    answer_.quantities_here = of_values(answer_.here);
    answer_.quantities.resize(answer_.designs() * width);
    return each("joints of designs", answer_.designs(), control, [&](std::size_t i) {
      const std::vector<double> found = of_values(answer_.values_of(answer_.first_design + i));
      std::copy(found.begin(), found.end(),
                answer_.quantities.begin() + static_cast<std::ptrdiff_t>(i * width));
    });
  }

 private:
  bool uses_closed_forms() const {
    return std::none_of(answer_.notes.begin(), answer_.notes.end(), [](const SweepNote& note) {
      return note.code == SweepNoteCode::differs_from_closed_form;
    });
  }

  std::span<plan::DesignLimit> limits_of(std::size_t i) {
    return std::span(answer_.limits).subspan(i * request_.targets.size(), request_.targets.size());
  }

  /// False if it was stopped.
  bool each(std::string_view stage, std::size_t count, const Control& control, const auto& body) {
    std::mutex mutex;
    std::size_t done = 0;
    // So many at a time: reports cost a lock.
    const std::size_t batch = std::max<std::size_t>(1, count / 1000);
    core::parallel_chunks(count, batch, [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last && !control.stop.stop_requested(); ++i) body(i);
      if (!control.progress) return;
      const std::lock_guard lock(mutex);
      done += last - first;
      control.progress(stage, done, count);
    });
    return !control.stop.stop_requested();
  }

  struct End {
    double value;
    std::optional<std::size_t> target;
  };

  /// Between a safe design and an unsafe one beside it: the border, by halving, then linearly between the last two if both have
  /// limits.
  End border(std::vector<double> values, double safe, double safe_margin, double unsafe,
             std::span<const plan::DesignLimit> beyond) {
    std::vector<plan::DesignLimit> limits(beyond.begin(), beyond.end()), tried(beyond.size());
    double unsafe_margin = answer::least_margin(request_.targets, limits);
    const double near = plan::border_share * request_.parameters.back().step;
    while (std::abs(unsafe - safe) > near) {
      const double middle = safe + (unsafe - safe) / 2;
      values.back() = middle;
      limits_.limits(values, tried);
      const double margin = answer::least_margin(request_.targets, tried);
      if (margin >= 0) {
        safe = middle, safe_margin = margin;
      } else {
        unsafe = middle, unsafe_margin = margin;
        std::copy(tried.begin(), tried.end(), limits.begin());
      }
    }
    // No target has a limit with a design that is in contact in its reference pose.
    if (std::isnan(unsafe_margin)) return {safe, std::nullopt};
    const double share = safe_margin / (safe_margin - unsafe_margin);
    return {safe + share * (unsafe - safe), answer::least_target(request_.targets, limits)};
  }

  std::vector<plan::SafeInterval> intervals(std::size_t line) {
    const std::size_t first = line * lines_.length;
    const auto values_at = [&](std::size_t k) { return answer_.values_of(answer_.first_design + first + k); };
    const auto margin = [&](std::size_t k) { return answer_.margin_deg[first + k]; };
    const auto end_between = [&](std::size_t safe, std::size_t unsafe) {
      return border(values_at(safe), values_at(safe).back(), margin(safe), values_at(unsafe).back(),
                    limits_of(first + unsafe));
    };
    std::vector<plan::SafeInterval> found;
    for (std::size_t k = 0; k < lines_.length; ++k) {
      if (!(margin(k) >= 0)) continue;
      plan::SafeInterval interval{lines_.first + line, values_at(k).back(), 0};
      if (k > 0) {
        const End end = end_between(k, k - 1);
        interval.low = end.value, interval.low_target = end.target;
      }
      while (k + 1 < lines_.length && margin(k + 1) >= 0) ++k;
      interval.high = values_at(k).back();
      if (k + 1 < lines_.length) {
        const End end = end_between(k, k + 1);
        interval.high = end.value, interval.high_target = end.target;
      }
      found.push_back(interval);
    }
    return found;
  }

  const SweepRequest& request_;
  const plan::DesignLimits& limits_;
  SweepAnswer& answer_;
  Lines lines_;
};

/// What the request itself leaves out, of each swept parameter.
void note_request(const Joint& joint, SweepAnswer& sweep) {
  for (const plan::SweptParameter& swept : sweep.parameters) {
    if (const double last = swept.value(swept.count() - 1); swept.ends_early())
      sweep.notes.push_back(
          {SweepNoteCode::last_value_left_out,
           swept.name +
               formatted(" is swept up to %.10g, not %.10g: the step of %.10g leads to no design there", last,
                         swept.last, swept.step)});
    const PartParameter& parameter = parameter_named(joint, swept.name);
    if (parameter.value != parameter.described)
      sweep.notes.push_back({SweepNoteCode::value_is_swept,
                             swept.name + formatted(" was set to %.10g and is swept: only the joint as it is "
                                                    "has that value, and no design changes by it",
                                                    parameter.value)});
  }
}

/// Limits of liner and neck by themselves at the joint's own values and in the corners of the sweep: bone that ends a motion before would hide
/// meshes that are not those of the implant's sizes.
std::string difference_from_closed_form(const plan::DesignLimits& limits, const SweepAnswer& sweep) {
  std::string difference = limits.difference_from_form(sweep.here);
  const std::size_t corners = std::size_t{1} << sweep.parameters.size();
  for (std::size_t corner = 0; corner < corners && difference.empty(); ++corner) {
    std::vector<double> values;
    for (std::size_t p = 0; p < sweep.parameters.size(); ++p) {
      const plan::SweptParameter& parameter = sweep.parameters[p];
      values.push_back(parameter.value(corner >> p & 1 ? parameter.count() - 1 : 0));
    }
    difference = limits.difference_from_form(values);
  }
  return difference;
}

/// What the limits of the targets' motions must be read with; of a joint that is in contact in its reference pose nothing.
std::vector<RangeNote> notes_on_limits(const Joint& joint, const SweepRequest& request,
                                       const SweepAnswer& sweep) {
  if (std::isnan(sweep.limits_here.front().turned_deg)) return {};
  std::vector<motion::Motion> motions;
  for (const plan::SweepTarget& target : request.targets) {
    const motion::Motion motion = target.without_tilt();
    const auto is_same = [&](const motion::Motion& other) {
      return other.name == motion.name && other.vary == motion.vary && other.sense == motion.sense &&
             other.start == motion.start && other.range == motion.range;
    };
    if (std::none_of(motions.begin(), motions.end(), is_same)) motions.push_back(motion);
  }
  const motion::RangeOfMotion range(joint, request.range);
  return range_notes(joint, range.limits(motions), request.range, range.bearing());
}

}  // namespace

SweepQuantities measured_quantities(std::span<const std::string> keys,
                                    const measure::MeasureOptions& request) {
  SweepQuantities quantities;
  std::vector<const measure::MeasureDefinition*> definitions;
  for (const std::string& key : keys) {
    const measure::MeasureDefinition* definition = measure::measure_definition(key);
    if (definition == nullptr) {
      std::string known;
      for (const measure::MeasureDefinition& each : measure::measure_definitions())
        known += (known.empty() ? "" : ", ") + std::string(each.key);
      throw UsageError("there is no measure \"" + core::one_line(key) + "\"; there are " + known);
    }
    definitions.push_back(definition);
    quantities.names.push_back("measured_" + key);
  }
  quantities.of = [definitions, request](const Joint& joint) {
    const measure::HipMeasures measures = measure::measure_hip(joint, request);
    std::vector<double> values;
    for (const measure::MeasureDefinition* each : definitions)
      values.push_back(each->of(measures).value.value_or(std::numeric_limits<double>::quiet_NaN()));
    return values;
  };
  return quantities;
}

std::vector<double> SweepAnswer::values_of(std::size_t design) const {
  std::vector<double> values(parameters.size());
  for (std::size_t p = parameters.size(); p-- > 0;) {
    values[p] = parameters[p].value(design % parameters[p].count());
    design /= parameters[p].count();
  }
  return values;
}

std::size_t designs_of(std::span<const plan::SweptParameter> parameters) {
  double all = 1;
  for (const plan::SweptParameter& each : parameters) all *= static_cast<double>(each.count());
  if (all > static_cast<double>(plan::most_designs))
    throw UsageError(formatted("%.0f designs are too many: up to %zu", all, plan::most_designs));
  return static_cast<std::size_t>(all);
}

void check_sweep(const Case& of, const SweepRequest& request) {
  const Joint& joint = of.joint;
  if (joint.kind == JointKind::free) throw UsageError("a sweep needs a joint whose centre is held");
  if (request.targets.empty()) throw UsageError("a sweep needs one target or more");
  if (request.parameters.empty() || request.parameters.size() > most_parameters)
    throw UsageError("a sweep is over one to four parameters");
  if (request.share.of < 1 || request.share.number < 1 || request.share.number > request.share.of)
    throw UsageError("the share of a sweep is a number from 1 to the number of shares");
  if (request.range.overlap.leave_out_reference_contacts)
    throw UsageError(
        "a sweep leaves no contacts of the reference pose out: they differ from design to design");
  std::vector<ParameterValue> low, high;
  for (const plan::SweptParameter& swept : request.parameters) {
    low.push_back({swept.name, swept.first});
    high.push_back({swept.name, swept.value(swept.count() - 1)});
  }
  (void)with_parameters(joint, low);  // throws for names and values that there are not
  (void)with_parameters(joint, high);
  for (const plan::SweptParameter& swept : request.parameters)
    if (parameter_named(joint, swept.name).kind == ParameterKind::size)
      throw UsageError(swept.name + ": sizes are not swept: rotations and translations of parts are");
  (void)designs_of(request.parameters);
  std::set<std::string_view> names;
  for (const plan::SweepTarget& target : request.targets) {
    check_target(target, joint);
    if (!names.insert(target.name).second)
      throw UsageError("target " + core::one_line(target.name) + " is given twice");
  }
  if (!request.bands) return;
  if (request.bands->any_sigma())
    throw UsageError(
        "standard deviations of centre, axes and surfaces: a sweep displaces parameters of parts only, by "
        "their sigma in the joint file");
  motion::check_band(band_options(of, *request.bands));
  if (!has_uncertain_parameters(joint))
    throw UsageError("a band needs a parameter with a standard deviation: sigma of [[part.parameter]]");
}

std::optional<SweepAnswer> answer_sweep(const Case& of, const SweepRequest& as_given,
                                        const Control& control) {
  check_sweep(of, as_given);
  const Joint& joint = of.joint;
  SweepRequest request = as_given;
  motion::RangeOptions& range = request.range;
  range.overlap.reference_pose = of.placement.reference_pose.angles;
  SweepAnswer answer{request.parameters, request.targets, {}, request.share};
  answer.best_by = request.best_by;
  const std::vector<std::string> names = names_of(request.parameters);
  for (const std::string& name : names) answer.here.push_back(parameter_named(joint, name).value);
  note_request(joint, answer);
  std::optional<plan::DesignLimits> made(std::in_place, joint, range, request.targets, names);
  if (const std::string difference = difference_from_closed_form(*made, answer); !difference.empty()) {
    answer.notes.push_back({SweepNoteCode::differs_from_closed_form,
                            "the meshes of the implant end motions elsewhere than bodies of the sizes in the "
                            "joint file, so that every limit is searched for: " +
                                difference});
    made.emplace(joint, range, request.targets, names, false);
  }
  const plan::DesignLimits& limits = *made;
  answer.pairs = limits.pairs();
  answer.limits_here.resize(request.targets.size());
  limits.limits(answer.here, answer.limits_here);
  answer.limit_notes = notes_on_limits(joint, request, answer);

  Sweeping sweeping(request, limits, answer);
  if (!sweeping.designs(control) || !sweeping.borders(control)) return std::nullopt;
  if (request.bands) {
    answer.band_options = band_options(of, *request.bands);
    if (!sweeping.probabilities(joint, *answer.band_options, control)) return std::nullopt;
  }
  if (!request.quantities.empty() && !sweeping.quantities(joint, control)) return std::nullopt;
  answer::summarise_sweep(answer);
  if (request.bands)
    answer.caveats.emplace_back(
        "probabilities are over the standard deviations of the parts' parameters only: not of the joint's "
        "centre, axes and surfaces");
  answer.caveats.emplace_back("all designs have the bearing part of the head of the given joint");
  return answer;
}

SweepAnswer answer_sweep(const Case& joint, const SweepRequest& request) {
  return *answer_sweep(joint, request, {});
}

}  // namespace condyle
