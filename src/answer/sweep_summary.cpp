#include "answer/sweep_summary.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "condyle/error.hpp"
#include "core/formatted.hpp"

namespace condyle {
namespace answer {
namespace {

using core::formatted;

double last_value(const plan::SweptParameter& parameter) {
  return parameter.value(parameter.count() - 1);
}

/// A line's share of the window by the trapezoidal rule over all parameters but the last one.
double line_weight(std::span<const plan::SweptParameter> parameters, std::size_t line) {
  double weight = 1;
  for (std::size_t p = parameters.size() - 1; p-- > 0;) {
    const std::size_t count = parameters[p].count(), at = line % count;
    line /= count;
    if (count > 1) weight *= parameters[p].step * (at == 0 || at + 1 == count ? 0.5 : 1.0);
  }
  return weight;
}

void measure(SweepAnswer& sweep) {
  const plan::SweptParameter& last = sweep.parameters.back();
  const std::size_t length = last.count(), first = sweep.first_design / length;
  sweep.window_measure = sweep.safe_measure = 0;
  for (std::size_t line = 0; line < sweep.designs() / length; ++line)
    sweep.window_measure += line_weight(sweep.parameters, first + line) * (last_value(last) - last.first);
  for (const plan::SafeInterval& interval : sweep.safe)
    sweep.safe_measure += line_weight(sweep.parameters, interval.line) * (interval.high - interval.low);
}

/// Steps from each design to the nearest one that is not safe, along the axes one after the other. No design beyond the sweep is known to be safe.
std::vector<std::uint32_t> steps_inside(const SweepAnswer& sweep) {
  constexpr std::uint32_t far = std::numeric_limits<std::uint32_t>::max() / 2;
  std::vector<std::uint32_t> steps(sweep.designs());
  for (std::size_t i = 0; i < steps.size(); ++i) steps[i] = sweep.margin_deg[i] >= 0 ? far : 0;
  std::size_t stride = 1;
  for (std::size_t p = sweep.parameters.size(); p-- > 0;) {
    const std::size_t count = sweep.parameters[p].count();
    const auto at = [&](std::size_t i) { return (sweep.first_design + i) / stride % count; };
    const auto take = [&](std::size_t i, bool has_neighbour, std::size_t neighbour) {
      steps[i] = std::min(steps[i], has_neighbour ? steps[neighbour] + 1 : 1);
    };
    if (count > 1) {
      for (std::size_t i = 0; i < steps.size(); ++i) take(i, at(i) > 0 && i >= stride, i - stride);
      for (std::size_t i = steps.size(); i-- > 0;)
        take(i, at(i) + 1 < count && i + stride < steps.size(), i + stride);
    }
    stride *= count;
  }
  return steps;
}

/// Steps from the joint as it is to a design, along the axes one after the other.
double steps_from_here(const SweepAnswer& sweep, std::size_t design) {
  const std::vector<double> values = sweep.values_of(design);
  double steps = 0;
  for (std::size_t p = 0; p < values.size(); ++p)
    steps += std::abs(values[p] - sweep.here[p]) / sweep.parameters[p].step;
  return std::round(1e9 * steps) / 1e9;  // the same to either side
}

std::span<const plan::DesignLimit> limits_of(const SweepAnswer& sweep, std::size_t i) {
  return std::span(sweep.limits).subspan(i * sweep.targets.size(), sweep.targets.size());
}

bool is_weighted(const SweepAnswer& sweep) {
  return std::any_of(sweep.targets.begin(), sweep.targets.end(),
                     [](const plan::SweepTarget& target) { return target.weight != 1; });
}

/// A margin that is left counts less for a heavier target, and one that is missed counts more.
double by_weight(double margin_deg, double weight) {
  return margin_deg >= 0 ? margin_deg / weight : margin_deg * weight;
}

/// The least of a design's margins by weight, and of which target.
struct LeastMargin {
  std::size_t target = 0;
  double margin = std::numeric_limits<double>::infinity();
};

LeastMargin least_by_weight(const SweepAnswer& sweep, std::size_t i) {
  LeastMargin least;
  const std::span<const plan::DesignLimit> limits = limits_of(sweep, i);
  for (std::size_t t = 0; t < limits.size(); ++t) {
    const plan::SweepTarget& target = sweep.targets[t];
    const double margin = by_weight(limits[t].turned_deg - target.reach.degrees(), target.weight);
    if (margin < least.margin) least = {t, margin};
  }
  return least;
}

/// The designs that are equally good, as indices into the share.
struct Equals {
  std::vector<std::size_t> designs = {};
  double merit = 0;            ///< of each: a margin, or less than 0 the steps from the joint as it is
  bool are_by_change = false;  ///< and not by their margin
};

Equals best_designs(const SweepAnswer& sweep) {
  const auto is_safe = [](double margin) { return margin >= 0; };
  Equals best{.are_by_change = sweep.best_by == BestDesign::least_change &&
                               std::any_of(sweep.margin_deg.begin(), sweep.margin_deg.end(), is_safe)};
  for (std::size_t i = 0; i < sweep.designs(); ++i) {
    const double margin = sweep.margin_deg[i];
    if (std::isnan(margin) || (best.are_by_change && !is_safe(margin))) continue;
    const double merit = best.are_by_change   ? -steps_from_here(sweep, sweep.first_design + i)
                         : is_weighted(sweep) ? least_by_weight(sweep, i).margin
                                              : margin;
    if (!best.designs.empty() && merit > best.merit) best.designs.clear();
    if (best.designs.empty()) best.merit = merit;
    if (merit == best.merit) best.designs.push_back(i);
  }
  return best;
}

void find_best(SweepAnswer& sweep, const std::vector<std::size_t>& equals) {
  sweep.best.reset();
  if (equals.empty()) return;
  const std::vector<std::uint32_t> inside = steps_inside(sweep);
  const std::size_t best = *std::min_element(equals.begin(), equals.end(), [&](std::size_t a, std::size_t b) {
    if (inside[a] != inside[b]) return inside[a] > inside[b];
    return steps_from_here(sweep, sweep.first_design + a) < steps_from_here(sweep, sweep.first_design + b);
  });
  sweep.best = sweep.first_design + best;
}

/// What ends the target of the least margin in all of these designs; empty if it is not the same.
std::string common_end(const SweepAnswer& sweep, const std::vector<std::size_t>& designs) {
  const auto end_of = [&](std::size_t i) {
    const std::size_t target = least_by_weight(sweep, i).target;
    return std::pair(target, limits_of(sweep, i)[target].pair);
  };
  const auto [target, pair] = end_of(designs.front());
  for (const std::size_t i : designs)
    if (end_of(i) != std::pair(target, pair)) return "";
  const std::string name = sweep.targets[target].name;
  if (pair == plan::DesignLimit::no_pair) return ": " + name + " ends with its range in all";
  return ": " + name + " ends with " + sweep.pairs[pair].mobile + " on " + sweep.pairs[pair].fixed +
         " in all";
}

/// By how much which target is missed, where that is least.
std::string nothing_text(const SweepAnswer& sweep) {
  if (!sweep.best) return "no design is safe: all are in contact in the reference pose";
  const std::size_t best = *sweep.best - sweep.first_design;
  return "no design is safe: the best one falls short of " +
         sweep.targets[least_target(sweep.targets, limits_of(sweep, best))].name +
         formatted(" by %.2f degrees", -sweep.margin_deg[best]);
}

bool is_safe_at(const SweepAnswer& sweep, std::size_t p, std::size_t wanted) {
  std::size_t stride = 1;
  for (std::size_t k = p + 1; k < sweep.parameters.size(); ++k) stride *= sweep.parameters[k].count();
  for (std::size_t i = 0; i < sweep.designs(); ++i)
    if (sweep.margin_deg[i] >= 0 && (sweep.first_design + i) / stride % sweep.parameters[p].count() == wanted)
      return true;
  return false;
}

/// "cup.inclination 50": the ends of what was swept at which a design is safe.
std::string safe_ends(const SweepAnswer& sweep) {
  std::string ends;
  for (std::size_t p = 0; p < sweep.parameters.size(); ++p) {
    const std::size_t count = sweep.parameters[p].count();
    if (count < 2) continue;
    for (const std::size_t end : {std::size_t{0}, count - 1})
      if (is_safe_at(sweep, p, end))
        ends += (ends.empty() ? "" : ", ") + sweep.parameters[p].name +
                formatted(" %.10g", sweep.parameters[p].value(end));
  }
  return ends;
}

/// By what several designs are equally good, and which of them is called best.
std::string shared_text(const SweepAnswer& sweep, const Equals& equals) {
  const std::size_t count = equals.designs.size();
  const std::string best = "; the best lies deepest in the zone";
  if (equals.are_by_change) return formatted("%zu safe designs change the joint as little", count) + best;
  return formatted("%zu designs share the largest %smargin, %.2f degrees", count,
                   is_weighted(sweep) ? "weighted " : "", equals.merit) +
         common_end(sweep, equals.designs) + best;
}

void note(SweepAnswer& sweep, const Equals& equals) {
  const auto add = [&](SweepNoteCode code, std::string text) {
    sweep.notes.push_back({code, std::move(text)});
  };
  const auto safe = static_cast<std::size_t>(std::count_if(sweep.margin_deg.begin(), sweep.margin_deg.end(),
                                                           [](double margin) { return margin >= 0; }));
  if (sweep.designs() == 0) return;  // of more shares than lines
  if (equals.designs.size() > 1) add(SweepNoteCode::best_is_shared, shared_text(sweep, equals));
  if (safe == 0) return add(SweepNoteCode::nothing_is_safe, nothing_text(sweep));
  if (safe == sweep.designs())
    return add(SweepNoteCode::everything_is_safe,
               "every design leaves all targets free: the zone extends beyond the sweep");
  if (const std::string ends = safe_ends(sweep); !ends.empty())
    add(SweepNoteCode::zone_leaves_window, "the safe zone extends beyond the sweep, at " + ends);
  std::size_t gaps = 0;
  for (std::size_t k = 1; k < sweep.safe.size(); ++k) gaps += sweep.safe[k].line == sweep.safe[k - 1].line;
  if (gaps > 0)
    add(SweepNoteCode::separate_intervals,
        "safe values of " + sweep.parameters.back().name +
            formatted(" are not side by side everywhere: %zu gaps between them", gaps));
}

bool is_of_request(SweepNoteCode code) noexcept {
  return std::find(std::begin(all_request_notes), std::end(all_request_notes), code) !=
         std::end(all_request_notes);
}

}  // namespace

double least_margin(std::span<const plan::SweepTarget> targets, std::span<const plan::DesignLimit> limits) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t t = 0; t < targets.size(); ++t) {
    const double margin = limits[t].turned_deg - targets[t].reach.degrees();
    if (!(margin >= least)) least = margin;  // NaN stays
    if (std::isnan(least)) break;
  }
  return least;
}

std::size_t least_target(std::span<const plan::SweepTarget> targets,
                         std::span<const plan::DesignLimit> limits) {
  std::size_t least = 0;
  const auto over = [&](std::size_t t) { return limits[t].turned_deg - targets[t].reach.degrees(); };
  for (std::size_t t = 1; t < targets.size(); ++t)
    if (over(t) < over(least)) least = t;
  return least;
}

void summarise_sweep(SweepAnswer& sweep) {
  measure(sweep);
  const Equals equals = best_designs(sweep);
  find_best(sweep, equals.designs);
  std::erase_if(sweep.notes, [](const SweepNote& each) { return !is_of_request(each.code); });
  note(sweep, equals);
}

}  // namespace answer

std::string_view name_of(BestDesign by) noexcept {
  return by == BestDesign::least_change ? "least_change" : "largest_margin";
}

std::string_view name_of(SweepNoteCode code) noexcept {
  switch (code) {
    case SweepNoteCode::differs_from_closed_form:
      return "differs_from_closed_form";
    case SweepNoteCode::nothing_is_safe:
      return "nothing_is_safe";
    case SweepNoteCode::everything_is_safe:
      return "everything_is_safe";
    case SweepNoteCode::zone_leaves_window:
      return "zone_leaves_window";
    case SweepNoteCode::separate_intervals:
      return "separate_intervals";
    case SweepNoteCode::last_value_left_out:
      return "last_value_left_out";
    case SweepNoteCode::best_is_shared:
      return "best_is_shared";
    case SweepNoteCode::value_is_swept:
      break;
  }
  return "value_is_swept";
}

SweepAnswer merged_sweep(std::span<const SweepAnswer> shares) {
  SweepAnswer whole = shares.front();
  for (std::size_t i = 1; i < shares.size(); ++i) {
    const SweepAnswer& share = shares[i];
    if (share.first_design != whole.first_design + whole.designs())
      throw UsageError(core::formatted("share %zu of a sweep does not follow share %zu", i + 1, i));
    whole.limits.insert(whole.limits.end(), share.limits.begin(), share.limits.end());
    whole.margin_deg.insert(whole.margin_deg.end(), share.margin_deg.begin(), share.margin_deg.end());
    whole.probability.insert(whole.probability.end(), share.probability.begin(), share.probability.end());
    whole.quantities.insert(whole.quantities.end(), share.quantities.begin(), share.quantities.end());
    whole.safe.insert(whole.safe.end(), share.safe.begin(), share.safe.end());
  }
  whole.share = {};
  answer::summarise_sweep(whole);
  return whole;
}

}  // namespace condyle
