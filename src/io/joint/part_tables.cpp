#include "io/joint/part_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

namespace condyle::io {
namespace {

std::optional<ParameterKind> kind_named(std::string_view name) {
  for (const ParameterKind kind : all_parameter_kinds)
    if (name_of(kind) == name) return kind;
  return std::nullopt;
}

ParameterKind kind_of(TomlTable& table, const std::string& name) {
  if (!table.has("kind")) {
    if (const auto kind = kind_named(name)) return *kind;
    table.fail_missing("kind",
                       fmt::format("parameter {}, whose name does not define how it moves its part", name));
  }
  return all_parameter_kinds[table.required_word(
      "kind", {"frontal", "inclination", "sagittal", "tilt", "version", "translation", "size",
               "cup_inclination", "cup_anteversion"})];
}

/// A word, or a vector of the joint frame.
Vec3 direction_of(TomlTable& table, Side side) {
  if (table.is_text("along")) {
    const double right = side == Side::right ? 1 : -1;
    const Vec3 directions[] = {Vec3::UnitX(), Vec3::UnitY(), Vec3(0, 0, right)};
    return directions[table.required_word("along", {"anterior", "superior", "lateral"})];
  }
  const Vec3 along = table.required("along", table.triple("along"));
  if (!(std::abs(along.norm() - 1) <= axis_tolerance)) table.fail("along", "must be a unit vector");
  return along.normalized();
}

PartParameter parameter_of(TomlTable& table, Side side, double mm) {
  PartParameter parameter;
  parameter.name = table.required("name", table.text("name"));
  parameter.kind = kind_of(table, parameter.name);
  const bool moves = parameter.kind == ParameterKind::translation;
  const double unit = moves ? mm : 1;
  const auto [low, high] = table.required("range", table.pair("range"));
  parameter.low = unit * low;
  parameter.high = unit * high;
  parameter.as_given =
      unit * table.number("as_given").value_or(parameter.kind == ParameterKind::size ? 1 : 0);
  const auto value = table.number("value");
  parameter.value = value ? unit * *value : parameter.as_given;
  if (parameter.value < parameter.low || parameter.value > parameter.high)
    table.fail(value ? "value" : "range",
               fmt::format("{} lies outside of the range, {} to {}", parameter.value / unit, low, high));
  parameter.sigma = unit * table.number("sigma").value_or(0);
  if (parameter.sigma < 0) table.fail("sigma", "must be 0 or more");
  if (moves)
    parameter.direction = direction_of(table, side);
  else if (table.has("along"))
    table.fail("along", "is for a translation");
  table.finish();
  return parameter;
}

/// Planes that the part is cut by, in the frame of the joint's centre.
std::vector<CutPlane> planes_of(TomlTable& table, double mm) {
  std::vector<CutPlane> planes;
  for (TomlTable& plane : table.tables("cut")) {
    const Vec3 point = plane.required("point", plane.triple("point")),
               normal = plane.required("normal", plane.triple("normal"));
    if (!(std::abs(normal.norm() - 1) <= axis_tolerance)) plane.fail("normal", "must be a unit vector");
    plane.finish();
    planes.push_back({mm * point, normal.normalized()});
  }
  if (table.has("cut") && planes.empty()) table.fail("cut", "needs one plane or more");
  return planes;
}

/// Definition of a cup's angles, without which they have no meaning.
CupDefinition definition_of(TomlTable& table, const PosedPart& part) {
  const bool is_cup =
      std::any_of(part.parameters.begin(), part.parameters.end(), [](const PartParameter& parameter) {
        return parameter.kind == ParameterKind::cup_inclination ||
               parameter.kind == ParameterKind::cup_anteversion;
      });
  if (is_cup)
    return all_cup_definitions[table.required_word("definition", {"radiographic", "anatomic", "operative"})];
  if (table.has("definition")) table.fail("definition", "is for cup_inclination and cup_anteversion");
  return CupDefinition::radiographic;
}

}  // namespace

std::vector<DescribedPart> described_parts(TomlTable& file, Side side, double mm) {
  std::vector<DescribedPart> parts;
  for (TomlTable& table : file.tables("part")) {
    DescribedPart described;
    PosedPart& part = described.part;
    part.name = table.required("name", table.text("name"));
    part.body = table.required_word("body", {"fixed", "mobile"}) == 0 ? BodyRole::fixed : BodyRole::mobile;
    part.meshes = table.texts("meshes").value_or(std::vector<std::string>{});
    if (table.has("meshes") && part.meshes.empty()) table.fail("meshes", "must name one mesh or more");
    part.cut = planes_of(table, mm);
    if (const auto centre = table.triple("centre")) described.centre_in_W = mm * *centre;
    for (TomlTable& parameter : table.tables("parameter"))
      part.parameters.push_back(parameter_of(parameter, side, mm));
    part.definition = definition_of(table, part);
    table.finish();
    parts.push_back(std::move(described));
  }
  return parts;
}

std::string parts_text(std::span<const PosedPart> parts) {
  std::string text;
  for (const PosedPart& part : parts) {
    text += fmt::format("\n[[part]]\nname = \"{}\"\nbody = \"{}\"\n", part.name,
                        part.body == BodyRole::fixed ? "fixed" : "mobile");
    if (!part.meshes.empty()) {
      std::string names;
      for (const std::string& mesh : part.meshes)
        names += fmt::format("{}\"{}\"", names.empty() ? "" : ", ", mesh);
      text += fmt::format("meshes = [{}]\n", names);
    }
    if (std::any_of(part.parameters.begin(), part.parameters.end(), [](const PartParameter& parameter) {
          return parameter.kind == ParameterKind::cup_inclination;
        }))
      text += fmt::format("definition = \"{}\"\n", name_of(part.definition));
    for (const PartParameter& parameter : part.parameters) {
      text += fmt::format("\n[[part.parameter]]\nname = \"{}\"\n", parameter.name);
      if (parameter.name != name_of(parameter.kind))
        text += fmt::format("kind = \"{}\"\n", name_of(parameter.kind));
      text +=
          fmt::format("as_given = {}\nrange = [{}, {}]\n", parameter.as_given, parameter.low, parameter.high);
      if (parameter.sigma > 0) text += fmt::format("sigma = {}\n", parameter.sigma);
    }
  }
  return text;
}

}  // namespace condyle::io
