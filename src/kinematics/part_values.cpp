#include <algorithm>
#include <charconv>
#include <cmath>

#include "condyle/error.hpp"
#include "condyle/joint.hpp"
#include "core/formatted.hpp"
#include "core/near_name.hpp"
#include "core/one_line.hpp"
#include "kinematics/posed_parts.hpp"

namespace condyle {
namespace {

using core::formatted;

std::string full_name(const PosedPart& part, const PartParameter& parameter) {
  return part.name + "." + parameter.name;
}

/// The values' unit as texts have it after a number.
std::string unit_text(const PartParameter& parameter) {
  return parameter.kind == ParameterKind::size ? "" : " " + std::string(unit_of(parameter.kind));
}

std::vector<std::string> names_of(const PosedParts& posed) {
  std::vector<std::string> names;
  for (const PosedPart& part : posed.parts)
    for (const PartParameter& parameter : part.parameters) names.push_back(full_name(part, parameter));
  return names;
}

PartParameter& parameter_named(PosedParts& posed, const std::string& name) {
  for (PosedPart& part : posed.parts)
    for (PartParameter& parameter : part.parameters)
      if (full_name(part, parameter) == name) return parameter;
  const std::vector<std::string> names = names_of(posed);
  std::string list;
  for (const std::string& each : names) list += (list.empty() ? "" : ", ") + each;
  throw UsageError("there is no parameter \"" + core::one_line(name) + "\"" +
                   core::did_you_mean(name, names) + "; there are " + core::one_line(list, 2000));
}

void set(PosedParts& posed, const ParameterValue& given) {
  PartParameter& parameter = parameter_named(posed, given.name);
  if (!std::isfinite(given.value)) throw UsageError(given.name + ": must be a finite number");
  if (given.value < parameter.low || given.value > parameter.high)
    throw UsageError(given.name + ": " + formatted("%.10g", given.value) + unit_text(parameter) +
                     formatted(" is outside of its range, %.10g to %.10g", parameter.low, parameter.high));
  parameter.value = given.value;
}

}  // namespace

std::string_view name_of(CupDefinition definition) noexcept {
  switch (definition) {
    case CupDefinition::radiographic:
      return "radiographic";
    case CupDefinition::anatomic:
      return "anatomic";
    case CupDefinition::operative:
      break;
  }
  return "operative";
}

CupDefinition cup_definition_named(std::string_view word) {
  for (const CupDefinition definition : all_cup_definitions)
    if (name_of(definition) == word) return definition;
  throw UsageError("definition \"" + core::one_line(word) +
                   "\" of a cup's angles is unknown; there are radiographic, anatomic, operative");
}

std::string_view name_of(ParameterKind kind) noexcept {
  constexpr std::string_view names[] = {"frontal", "inclination",     "sagittal",
                                        "tilt",    "version",         "translation",
                                        "size",    "cup_inclination", "cup_anteversion"};
  return names[static_cast<std::size_t>(kind)];
}

std::string_view unit_of(ParameterKind kind) noexcept {
  return kind == ParameterKind::translation ? "mm" : kind == ParameterKind::size ? "1" : "deg";
}

std::vector<ParameterValue> parse_parameters(std::string_view text) {
  std::vector<ParameterValue> values;
  while (true) {
    const auto first = text.find_first_not_of(" \t,");
    if (first == text.npos) break;
    text.remove_prefix(first);
    const std::string_view item = text.substr(0, text.find_first_of(" \t,"));
    text.remove_prefix(item.size());
    const auto equals = item.find('=');
    const auto number = equals == item.npos ? std::string_view() : item.substr(equals + 1);
    double value = 0;
    const auto [stopped, error] = std::from_chars(number.data(), number.data() + number.size(), value);
    if (equals == item.npos || equals == 0 || error != std::errc() ||
        stopped != number.data() + number.size() || !std::isfinite(value))
      throw UsageError("\"" + core::one_line(item) +
                       "\" is not a parameter and its value, as in cup.inclination=42");
    values.push_back({std::string(item.substr(0, equals)), value});
  }
  if (values.empty()) throw UsageError("no parameter is given, as in cup.inclination=42");
  return values;
}

Joint with_parameters(const Joint& joint, std::span<const ParameterValue> values) {
  Joint moved = joint;
  if (values.empty()) return moved;
  if (!moved.posed) throw UsageError("the joint has no part with parameters: its file has no [[part]]");
  for (std::size_t i = 0; i < values.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k)
      if (values[k].name == values[i].name)
        throw UsageError(core::one_line(values[i].name) + " is given twice");
    set(*moved.posed, values[i]);
  }
  kinematics::pose_parts(moved);
  return moved;
}

std::string changed_parameters(const Joint& joint) {
  std::string text;
  if (!joint.posed) return text;
  for (const PosedPart& part : joint.posed->parts)
    for (const PartParameter& parameter : part.parameters)
      if (parameter.value != parameter.described)
        text += (text.empty() ? "" : ", ") + full_name(part, parameter) +
                formatted(" %.10g", parameter.value) + unit_text(parameter) +
                formatted(" instead of %.10g", parameter.described);
  return text;
}

bool has_uncertain_parameters(const Joint& joint) noexcept {
  return kinematics::uncertain_parameters(joint) > 0;
}

}  // namespace condyle
