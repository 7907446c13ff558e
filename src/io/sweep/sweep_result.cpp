#include "io/sweep/sweep_result.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "condyle/error.hpp"
#include "condyle/io/pose_text.hpp"
#include "core/counted.hpp"
#include "io/file/csv_fields.hpp"
#include "io/file/format_version.hpp"
#include "io/joint/given_degrees.hpp"
#include "io/result/map_result.hpp"
#include "io/result/provenance_forms.hpp"
#include "io/result/rom_result.hpp"
#include "io/result/scope_text.hpp"

namespace condyle::io {
namespace {

using io::Json;

std::span<const plan::DesignLimit> limits_of(const SweepAnswer& sweep, std::size_t design) {
  return std::span(sweep.limits)
      .subspan((design - sweep.first_design) * sweep.targets.size(), sweep.targets.size());
}

std::span<const double> quantities_of(const SweepAnswer& sweep, std::size_t design) {
  const std::size_t width = sweep.quantity_names.size();
  return std::span(sweep.quantities).subspan((design - sweep.first_design) * width, width);
}

/// A line for each quantity, of the joint as it is and of the best design; its least and greatest value.
std::string quantities_text(const SweepAnswer& sweep) {
  std::string text;
  const auto shown = [](double value) {
    return std::isnan(value) ? std::string("-") : fmt::format("{:.4g}", value);
  };
  for (std::size_t q = 0; q < sweep.quantity_names.size(); ++q) {
    double low = std::numeric_limits<double>::quiet_NaN(), high = low;
    for (std::size_t i = q; i < sweep.quantities.size(); i += sweep.quantity_names.size())
      low = std::fmin(low, sweep.quantities[i]), high = std::fmax(high, sweep.quantities[i]);
    text += fmt::format(
        "  {}: here {}, best {}, all {} to {}\n", sweep.quantity_names[q], shown(sweep.quantities_here[q]),
        sweep.best ? shown(quantities_of(sweep, *sweep.best)[q]) : "-", shown(low), shown(high));
  }
  return text;
}

Json quantities_json(const SweepAnswer& sweep, std::span<const double> values) {
  Json json = Json::object();
  for (std::size_t q = 0; q < values.size(); ++q)
    json[sweep.quantity_names[q]] = std::isnan(values[q]) ? Json(nullptr) : Json(values[q]);
  return json;
}

double margin_of(const SweepAnswer& sweep, std::size_t design) {
  return sweep.margin_deg[design - sweep.first_design];
}

std::size_t count_safe(const SweepAnswer& sweep) {
  return static_cast<std::size_t>(std::count_if(sweep.margin_deg.begin(), sweep.margin_deg.end(),
                                                [](double margin) { return margin >= 0; }));
}

/// "neck on liner".
std::string ending_text(const SweepAnswer& sweep, const plan::DesignLimit& limit) {
  if (limit.pair == plan::DesignLimit::no_pair) return "";
  const plan::EndingPair& pair = sweep.pairs[limit.pair];
  return fmt::format("{} on {}", pair.mobile, pair.fixed);
}

/// "cup.inclination 40, cup.anteversion 15".
std::string values_text(const SweepAnswer& sweep, std::span<const double> values) {
  std::string text;
  for (std::size_t p = 0; p < values.size(); ++p)
    text += fmt::format("{}{} {:.10g}", text.empty() ? "" : ", ", sweep.parameters[p].name, values[p]);
  return text;
}

/// The target with a design's smallest margin, and the margin.
std::string margin_text(const SweepAnswer& sweep, std::span<const plan::DesignLimit> limits) {
  if (std::isnan(limits.front().turned_deg))
    return fmt::format("in contact in the reference pose: {}", ending_text(sweep, limits.front()));
  std::size_t least = 0;
  const auto over = [&](std::size_t t) { return limits[t].turned_deg - sweep.targets[t].reach.degrees(); };
  for (std::size_t t = 1; t < limits.size(); ++t)
    if (over(t) < over(least)) least = t;
  return over(least) >= 0
             ? fmt::format("safe, {:.2f} deg to spare of {}", over(least), sweep.targets[least].name)
             : fmt::format("not safe, {:.2f} deg short of {}", -over(least), sweep.targets[least].name);
}

std::string limit_text(const plan::DesignLimit& limit) {
  if (std::isnan(limit.turned_deg)) return "-";
  return fmt::format("{}{:.2f}", limit.reason == motion::LimitReason::end_of_range ? ">" : "",
                     limit.turned_deg);
}

std::string measure_text(const SweepAnswer& sweep) {
  std::string unit;
  for (const plan::SweptParameter& parameter : sweep.parameters)
    if (parameter.count() > 1) unit += fmt::format("{}{}", unit.empty() ? "" : " x ", parameter.name);
  if (!(sweep.window_measure > 0)) return "";
  return fmt::format("; {:.6g} of {:.6g} ({}), {:.1f} %", sweep.safe_measure, sweep.window_measure, unit,
                     100 * sweep.safe_measure / sweep.window_measure);
}

std::string table_of_targets(const SweepAnswer& sweep) {
  std::size_t widest = 6;
  for (const plan::SweepTarget& target : sweep.targets) widest = std::max(widest, target.name.size());
  std::string text = fmt::format("  {:<{}}  {:>7}  {:>9}  {:>9}  {:>12}  ended by\n", "target", widest,
                                 "reach", "here", "best", "missed by");
  for (std::size_t t = 0; t < sweep.targets.size(); ++t) {
    const double reach = sweep.targets[t].reach.degrees();
    std::size_t missed = 0;
    std::vector<bool> ends(sweep.pairs.size());
    for (std::size_t i = 0; i < sweep.designs(); ++i) {
      const plan::DesignLimit& limit = sweep.limits[i * sweep.targets.size() + t];
      missed += !(limit.turned_deg >= reach);
      if (limit.pair != plan::DesignLimit::no_pair) ends[limit.pair] = true;
    }
    std::string by;
    for (std::size_t k = 0; k < ends.size(); ++k)
      if (ends[k])
        by += fmt::format("{}{} on {}", by.empty() ? "" : ", ", sweep.pairs[k].mobile, sweep.pairs[k].fixed);
    text += fmt::format("  {:<{}}  {:>7.10g}  {:>9}  {:>9}  {:>12}  {}\n", sweep.targets[t].name, widest,
                        io::given_degrees(sweep.targets[t].reach), limit_text(sweep.limits_here[t]),
                        sweep.best ? limit_text(limits_of(sweep, *sweep.best)[t]) : "-",
                        fmt::format("{}", missed), by.empty() ? "-" : by);
  }
  return text;
}

Json limit_json(const SweepAnswer& sweep, std::span<const plan::DesignLimit> limits) {
  Json list = Json::array();
  for (std::size_t t = 0; t < limits.size(); ++t) {
    const plan::DesignLimit& limit = limits[t];
    list.push_back({{"target", sweep.targets[t].name},
                    {"limit_deg", std::isnan(limit.turned_deg) ? Json(nullptr) : Json(limit.turned_deg)},
                    {"reason", name_of(limit.reason)},
                    {"ended_by", limit.pair == plan::DesignLimit::no_pair
                                     ? Json(nullptr)
                                     : Json{{"fixed", sweep.pairs[limit.pair].fixed},
                                            {"mobile", sweep.pairs[limit.pair].mobile}}},
                    {"known_by", name_of(limit.by)}});
  }
  return list;
}

Json values_json(const SweepAnswer& sweep, std::span<const double> values) {
  Json json;
  for (std::size_t p = 0; p < values.size(); ++p) json[sweep.parameters[p].name] = values[p];
  return json;
}

Json target_json(const plan::SweepTarget& target, Anatomy anatomy) {
  Json start;
  for (const JointAngle angle : all_joint_angles)
    start[name_of(angle, anatomy)] = io::given_degrees(angle_of(target.motion.start, angle));
  return {{"name", target.name},
          {"motion", target.motion.name},
          {"movement", movement_name(target.motion.vary, target.motion.sense, anatomy)},
          {"start_deg", std::move(start)},
          {"range_deg", io::given_degrees(target.motion.range)},
          {"reach_deg", io::given_degrees(target.reach)},
          {"weight", target.weight},
          {"pelvic_tilt_deg", io::given_degrees(target.pelvic_tilt)},
          {"source", target.source.empty() ? Json(nullptr) : Json(target.source)}};
}

std::size_t known_by_form(const SweepAnswer& sweep) {
  return static_cast<std::size_t>(std::count_if(
      sweep.limits.begin(), sweep.limits.end(),
      [](const plan::DesignLimit& limit) { return limit.by == plan::LimitKnownBy::closed_form; }));
}

ParameterKind swept_kind(const Joint& joint, const std::string& name) {
  for (const PosedPart& part : joint.posed->parts)
    for (const PartParameter& parameter : part.parameters)
      if (part.name + "." + parameter.name == name) return parameter.kind;
  throw UsageError("there is no parameter \"" + name + "\"");  // callers have checked it
}

std::string target_name(const SweepAnswer& sweep, const std::optional<std::size_t>& target) {
  return target ? io::csv_field(sweep.targets[*target].name) : std::string();
}

}  // namespace

SweepResult sweep_result_of(const LoadedJoint& loaded, SweepAnswer answer, std::span<const JointNote> notes,
                            const Provenance* from) {
  SweepResult result{.joint = loaded.joint.name,
                     .anatomy = loaded.joint.anatomy,
                     .side = loaded.joint.side,
                     .scope = scope_text(loaded.joint),
                     .answer = std::move(answer)};
  for (const plan::SweptParameter& swept : result.answer.parameters)
    result.units.emplace_back(unit_of(swept_kind(loaded.joint, swept.name)));
  result.notes = io::notes_json(notes, {}, result.answer.limit_notes);
  result.provenance = io::provenance_json(from);
  return result;
}

std::string sweep_text(const SweepResult& result) {
  const SweepAnswer& sweep = result.answer;
  std::string axes;
  for (const plan::SweptParameter& each : sweep.parameters)
    axes += fmt::format("{}{} {:.10g} to {:.10g} by {:.10g}", axes.empty() ? "" : ", ", each.name, each.first,
                        each.last, each.step);
  std::string text =
      fmt::format("{}: {}\n  {}, {}", result.joint, axes, core::counted(sweep.designs(), "design", "designs"),
                  core::counted(sweep.targets.size(), "target", "targets"));
  if (sweep.share.of > 1) text += fmt::format("; share {} of {}", sweep.share.number, sweep.share.of);
  text += fmt::format("\n  safe: {}{}\n", core::counted(count_safe(sweep), "design", "designs"),
                      measure_text(sweep));
  text +=
      fmt::format("  here: {}: {}\n", values_text(sweep, sweep.here), margin_text(sweep, sweep.limits_here));
  if (sweep.best) {
    text += fmt::format(
        "  best{}: {}: {}",
        sweep.best_by == BestDesign::least_change && margin_of(sweep, *sweep.best) >= 0 ? ", of least change"
                                                                                        : "",
        values_text(sweep, sweep.values_of(*sweep.best)), margin_text(sweep, limits_of(sweep, *sweep.best)));
    if (!sweep.probability.empty())
      text += fmt::format(", {:.1f} % likely", 100 * sweep.probability[*sweep.best - sweep.first_design]);
    text += "\n";
  }
  if (!sweep.probability.empty()) {
    const auto most = std::max_element(sweep.probability.begin(), sweep.probability.end());
    text += fmt::format(
        "  most likely safe: {}: {:.1f} % of {} displaced designs\n",
        values_text(sweep, sweep.values_of(sweep.first_design +
                                           static_cast<std::size_t>(most - sweep.probability.begin()))),
        100 * *most, result.answer.band_options->samples);
  }
  text += table_of_targets(sweep) + quantities_text(sweep);
  if (const std::size_t forms = known_by_form(sweep); forms > 0)
    text += fmt::format("  {} of {} limits in closed form, the others by the meshes\n", forms,
                        sweep.limits.size());
  for (const std::string& caveat : sweep.caveats) text += fmt::format("  {}\n", caveat);
  return text + fmt::format("  {}\n", result.scope);
}

Json sweep_object(const SweepResult& result) {
  const SweepAnswer& sweep = result.answer;
  Json parameters = Json::array(), targets = Json::array(), pairs = Json::array(), notes = Json::array();
  for (std::size_t p = 0; p < sweep.parameters.size(); ++p) {
    const plan::SweptParameter& each = sweep.parameters[p];
    parameters.push_back({{"name", each.name},
                          {"unit", result.units[p]},
                          {"first", each.first},
                          {"last", each.last},
                          {"step", each.step},
                          {"count", each.count()}});
  }
  for (const plan::SweepTarget& target : sweep.targets)
    targets.push_back(target_json(target, result.anatomy));
  for (const plan::EndingPair& pair : sweep.pairs)
    pairs.push_back({{"fixed", pair.fixed}, {"mobile", pair.mobile}});
  for (const SweepNote& note : sweep.notes)
    notes.push_back({{"code", name_of(note.code)}, {"text", note.text}});
  Json best = nullptr;
  if (sweep.best)
    best = {{"values", values_json(sweep, sweep.values_of(*sweep.best))},
            {"margin_deg", margin_of(sweep, *sweep.best)},
            {"quantities", quantities_json(sweep, quantities_of(sweep, *sweep.best))},
            {"limits", limit_json(sweep, limits_of(sweep, *sweep.best))}};
  Json json{{"condyle", io::format_version},
            {"joint", result.joint},
            {"anatomy", name_of(result.anatomy)},
            {"side", name_of(result.side)},
            {"parameters", std::move(parameters)},
            {"targets", std::move(targets)},
            {"share", {{"number", sweep.share.number}, {"of", sweep.share.of}}},
            {"first_design", sweep.first_design},
            {"designs", sweep.designs()},
            {"safe_designs", count_safe(sweep)},
            {"safe_measure", sweep.safe_measure},
            {"window_measure", sweep.window_measure},
            {"here",
             {{"values", values_json(sweep, sweep.here)},
              {"quantities", quantities_json(sweep, sweep.quantities_here)},
              {"limits", limit_json(sweep, sweep.limits_here)}}},
            {"best_by", name_of(sweep.best_by)},
            {"best", std::move(best)},
            {"ending_pairs", std::move(pairs)},
            {"quantities", sweep.quantity_names},
            {"limits_in_closed_form", known_by_form(sweep)},
            {"band", result.answer.band_options ? Json{{"samples", result.answer.band_options->samples},
                                                       {"seed", result.answer.band_options->seed}}
                                                : Json(nullptr)},
            {"sweep_notes", std::move(notes)},
            {"caveats", sweep.caveats},
            {"notes", result.notes},
            {"scope", result.scope},
            {"provenance", result.provenance}};
  return json;
}

std::string sweep_json(const SweepResult& result) {
  return io::document(io::sweep_object(result));
}

std::string designs_csv(const SweepResult& result) {
  const SweepAnswer& sweep = result.answer;
  std::string text;
  for (const plan::SweptParameter& parameter : sweep.parameters) text += io::csv_field(parameter.name) + ",";
  text += "margin_deg,safe";
  if (result.answer.band_options) text += ",probability";
  for (const std::string& name : sweep.quantity_names) text += "," + io::csv_field(name);
  for (const plan::SweepTarget& target : sweep.targets)
    for (const char* column : {"limit_deg", "reason", "ended_by", "known_by"})
      text += "," + io::csv_field(fmt::format("{}_{}", target.name, column));
  text += "\n";
  for (std::size_t i = 0; i < sweep.designs(); ++i) {
    for (const double value : sweep.values_of(sweep.first_design + i)) text += fmt::format("{},", value);
    const double margin = sweep.margin_deg[i];
    text += std::isnan(margin) ? ",0" : fmt::format("{},{}", margin, margin >= 0 ? 1 : 0);
    if (result.answer.band_options) text += fmt::format(",{}", sweep.probability[i]);
    for (const double value : quantities_of(sweep, sweep.first_design + i))
      text += std::isnan(value) ? "," : fmt::format(",{}", value);
    for (const plan::DesignLimit& limit : limits_of(sweep, sweep.first_design + i)) {
      text += std::isnan(limit.turned_deg) ? "," : fmt::format(",{}", limit.turned_deg);
      text += fmt::format(",{},{},{}", name_of(limit.reason), io::csv_field(ending_text(sweep, limit)),
                          name_of(limit.by));
    }
    text += "\n";
  }
  return text;
}

std::string safe_csv(const SweepResult& result) {
  const SweepAnswer& sweep = result.answer;
  const std::size_t others = sweep.parameters.size() - 1;
  std::string text;
  for (std::size_t p = 0; p < others; ++p) text += io::csv_field(sweep.parameters[p].name) + ",";
  const std::string& last = sweep.parameters.back().name;
  text += fmt::format("{},{},low_target,high_target\n", io::csv_field(last + "_low"),
                      io::csv_field(last + "_high"));
  for (const plan::SafeInterval& interval : sweep.safe) {
    const std::vector<double> values = sweep.values_of(interval.line * sweep.parameters.back().count());
    for (std::size_t p = 0; p < others; ++p) text += fmt::format("{},", values[p]);
    text += fmt::format("{},{},{},{}\n", interval.low, interval.high, target_name(sweep, interval.low_target),
                        target_name(sweep, interval.high_target));
  }
  return text;
}

}  // namespace condyle::io
