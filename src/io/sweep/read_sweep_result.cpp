#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "answer/sweep_summary.hpp"
#include "condyle/error.hpp"
#include "condyle/io/pose_text.hpp"
#include "io/file/csv_fields.hpp"
#include "io/result/map_result.hpp"
#include "io/result/rom_result.hpp"
#include "io/sweep/sweep_result.hpp"

namespace condyle::io {
namespace {

/// Rows of a table that a share has, each as many fields as its header.
std::vector<std::vector<std::string>> rows_of(std::string_view text, const std::string& name) {
  const Source source{text, name};
  TextCursor cursor(source);
  std::vector<std::vector<std::string>> rows;
  while (!cursor.at_end()) {
    const std::size_t line = cursor.line();
    rows.push_back(csv_fields(cursor.rest_of_line(), line, source));
    if (rows.back().size() != rows.front().size()) source.fail(fmt::format("line {}: is not whole", line));
  }
  if (rows.empty()) source.fail("is empty");
  rows.erase(rows.begin());
  return rows;
}

double number_in(const std::string& field, const std::string& name) {
  if (field.empty()) return std::numeric_limits<double>::quiet_NaN();
  double value = 0;
  if (!parse_number(field, value))
    throw FileError(fmt::format("{}: {} is no number", name, in_quotes(field)));
  return value;
}

JointAngles angles_in(const Json& json, Anatomy anatomy) {
  const auto angle = [&](JointAngle which) {
    return Angle::degrees(json.at(std::string(name_of(which, anatomy))).get<double>());
  };
  return {angle(JointAngle::flexion), angle(JointAngle::adduction), angle(JointAngle::internal_rotation)};
}

plan::SweepTarget target_in(const Json& json, Anatomy anatomy) {
  plan::SweepTarget target{json.at("name").get<std::string>()};
  target.motion.name = json.at("motion").get<std::string>();
  for (const JointAngle angle : all_joint_angles)
    for (const RotationSense sense : {RotationSense::positive, RotationSense::negative})
      if (json.at("movement").get<std::string>() == movement_name(angle, sense, anatomy))
        target.motion.vary = angle, target.motion.sense = sense;
  target.motion.start = angles_in(json.at("start_deg"), anatomy);
  target.motion.range = Angle::degrees(json.at("range_deg").get<double>());
  target.reach = Angle::degrees(json.at("reach_deg").get<double>());
  target.pelvic_tilt = Angle::degrees(json.at("pelvic_tilt_deg").get<double>());
  target.weight = json.at("weight").get<double>();
  if (!json.at("source").is_null()) target.source = json.at("source").get<std::string>();
  return target;
}

motion::LimitReason reason_in(std::string_view word) {
  for (const motion::LimitReason reason :
       {motion::LimitReason::contact, motion::LimitReason::contact_at_start, motion::LimitReason::ligament,
        motion::LimitReason::strained_at_start})
    if (word == name_of(reason)) return reason;
  return motion::LimitReason::end_of_range;
}

plan::LimitKnownBy known_in(std::string_view word) {
  return word == name_of(plan::LimitKnownBy::meshes) ? plan::LimitKnownBy::meshes
                                                     : plan::LimitKnownBy::closed_form;
}

std::uint16_t pair_in(const SweepAnswer& sweep, std::string_view fixed, std::string_view mobile) {
  for (std::size_t i = 0; i < sweep.pairs.size(); ++i)
    if (sweep.pairs[i].fixed == fixed && sweep.pairs[i].mobile == mobile)
      return static_cast<std::uint16_t>(i);
  return plan::DesignLimit::no_pair;
}

/// The pair of "neck on liner", whose names may hold " on " too.
std::uint16_t pair_in(const SweepAnswer& sweep, std::string_view text) {
  for (std::size_t i = 0; i < sweep.pairs.size(); ++i)
    if (text == fmt::format("{} on {}", sweep.pairs[i].mobile, sweep.pairs[i].fixed))
      return static_cast<std::uint16_t>(i);
  return plan::DesignLimit::no_pair;
}

void read_document(const Json& json, SweepResult& result) {
  SweepAnswer& sweep = result.answer;
  result.joint = json.at("joint").get<std::string>();
  for (const Anatomy anatomy : all_anatomies)
    if (json.at("anatomy").get<std::string>() == name_of(anatomy)) result.anatomy = anatomy;
  result.side = json.at("side").get<std::string>() == name_of(Side::left) ? Side::left : Side::right;
  result.scope = json.at("scope").get<std::string>();
  result.notes = json.at("notes");
  result.provenance = json.at("provenance");
  for (const Json& each : json.at("parameters")) {
    sweep.parameters.push_back({each.at("name").get<std::string>(), each.at("first").get<double>(),
                                each.at("last").get<double>(), each.at("step").get<double>()});
    result.units.push_back(each.at("unit").get<std::string>());
  }
  for (const Json& each : json.at("targets")) sweep.targets.push_back(target_in(each, result.anatomy));
  for (const Json& each : json.at("ending_pairs"))
    sweep.pairs.push_back({each.at("fixed").get<std::string>(), each.at("mobile").get<std::string>()});
  sweep.share = {json.at("share").at("number").get<std::size_t>(),
                 json.at("share").at("of").get<std::size_t>()};
  sweep.first_design = json.at("first_design").get<std::size_t>();
  if (json.at("best_by").get<std::string>() == name_of(BestDesign::least_change))
    sweep.best_by = BestDesign::least_change;
  for (const plan::SweptParameter& each : sweep.parameters)
    sweep.here.push_back(json.at("here").at("values").at(each.name).get<double>());
  for (const Json& each : json.at("here").at("limits")) {
    const Json& by = each.at("ended_by");
    sweep.limits_here.push_back(
        {each.at("limit_deg").is_null() ? std::numeric_limits<double>::quiet_NaN()
                                        : each.at("limit_deg").get<double>(),
         reason_in(each.at("reason").get<std::string>()), known_in(each.at("known_by").get<std::string>()),
         by.is_null()
             ? plan::DesignLimit::no_pair
             : pair_in(sweep, by.at("fixed").get<std::string>(), by.at("mobile").get<std::string>())});
  }
  for (const Json& each : json.at("sweep_notes"))
    for (const SweepNoteCode code : all_request_notes)
      if (each.at("code").get<std::string>() == name_of(code))
        sweep.notes.push_back({code, each.at("text").get<std::string>()});
  for (const Json& each : json.at("quantities")) {
    sweep.quantity_names.push_back(each.get<std::string>());
    const Json& here = json.at("here").at("quantities").at(sweep.quantity_names.back());
    sweep.quantities_here.push_back(here.is_null() ? std::numeric_limits<double>::quiet_NaN()
                                                   : here.get<double>());
  }
  for (const Json& each : json.at("caveats")) sweep.caveats.push_back(each.get<std::string>());
  if (const Json& band = json.at("band"); !band.is_null()) {
    result.answer.band_options.emplace();
    result.answer.band_options->samples = band.at("samples").get<std::size_t>();
    result.answer.band_options->seed = band.at("seed").get<std::uint64_t>();
  }
}

}  // namespace

SweepResult read_sweep_result(const Json& json, std::string_view designs, std::string_view safe,
                              std::string_view name) {
  SweepResult result;
  SweepAnswer& sweep = result.answer;
  try {
    read_document(json, result);
  } catch (const nlohmann::json::exception& error) {
    throw FileError(fmt::format("{}: sweep.json: is not whole: {}", name, error.what()));
  }
  const bool has_probability = result.answer.band_options.has_value();
  const std::size_t first_quantity = sweep.parameters.size() + 2 + (has_probability ? 1 : 0);
  const std::size_t first_target = first_quantity + sweep.quantity_names.size();
  const std::string designs_name = fmt::format("{}/designs.csv", name),
                    safe_name = fmt::format("{}/safe.csv", name);
  for (const auto& row : rows_of(designs, designs_name)) {
    if (row.size() != first_target + 4 * sweep.targets.size())
      throw FileError(designs_name + ": has other columns than sweep.json says");
    sweep.margin_deg.push_back(number_in(row[sweep.parameters.size()], designs_name));
    if (has_probability) sweep.probability.push_back(number_in(row[first_quantity - 1], designs_name));
    for (std::size_t c = first_quantity; c < first_target; ++c)
      sweep.quantities.push_back(number_in(row[c], designs_name));
    for (std::size_t c = first_target; c < row.size(); c += 4)
      sweep.limits.push_back({number_in(row[c], designs_name), reason_in(row[c + 1]), known_in(row[c + 3]),
                              pair_in(sweep, row[c + 2])});
  }
  const auto target_in = [&](const std::string& target) -> std::optional<std::size_t> {
    for (std::size_t t = 0; t < sweep.targets.size(); ++t)
      if (sweep.targets[t].name == target) return t;
    return std::nullopt;
  };
  const std::size_t others = sweep.parameters.size() - 1;
  for (const auto& row : rows_of(safe, safe_name)) {
    if (row.size() != others + 4) throw FileError(safe_name + ": has other columns than sweep.json says");
    std::size_t line = 0;
    for (std::size_t p = 0; p < others; ++p) {
      const plan::SweptParameter& parameter = sweep.parameters[p];
      const double value = number_in(row[p], safe_name);
      line = line * parameter.count() +
             static_cast<std::size_t>(std::lround((value - parameter.first) / parameter.step));
    }
    sweep.safe.push_back({line, number_in(row[others], safe_name), number_in(row[others + 1], safe_name),
                          target_in(row[others + 2]), target_in(row[others + 3])});
  }
  answer::summarise_sweep(sweep);
  return result;
}

}  // namespace condyle::io
