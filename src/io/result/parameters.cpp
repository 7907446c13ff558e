#include "io/result/parameters.hpp"

#include <fmt/format.h>

#include <utility>

#include "core/one_line.hpp"
#include "kinematics/ligament_path.hpp"

namespace condyle::io {

std::string planned_text(const Joint& joint) {
  const std::string changed = changed_parameters(joint);
  return joint.planned + (joint.planned.empty() || changed.empty() ? "" : ", ") + changed;
}

std::string whose_text(const Joint& joint) {
  std::string text;
  if (joint.units != LengthUnit::millimetres) text += fmt::format(", meshes in {}", plural_of(joint.units));
  if (!joint.person.is_human())
    text += fmt::format(", of {}", core::one_line(joint.person.species, joint.person.species.size()));
  return text;
}

std::string parameters_text(const Joint& joint) {
  std::string text;
  if (!joint.planned.empty()) text += fmt::format("  planned: {}\n", joint.planned);
  if (const std::string changed = changed_parameters(joint); !changed.empty())
    text += fmt::format("  not as in the joint file: {}\n", changed);
  for (const CupDefinition definition : all_cup_definitions)
    if (const auto cup = plan::cup_angles(joint, definition))
      text +=
          fmt::format("{}{:.2f} {:.2f} {}",
                      text.ends_with('\n') || text.empty() ? "  cup, inclination and anteversion: " : ", ",
                      cup->inclination.degrees(), cup->anteversion.degrees(), name_of(definition));
  return text.empty() || text.ends_with('\n') ? text : text + "\n";
}

Json cup_json(std::span<const plan::CupAngles> cup) {
  Json json;
  for (const plan::CupAngles& angles : cup)
    json[name_of(angles.definition)] = {{"inclination_deg", angles.inclination.degrees()},
                                        {"anteversion_deg", angles.anteversion.degrees()}};
  return json;
}

std::string sigmas_text(const Joint& joint) {
  std::string text;
  for (const kinematics::LigamentSigma& of : kinematics::ligament_sigmas(joint))
    text += fmt::format(", {} by {:g} mm", of.name, of.sigma_mm);
  if (!joint.posed) return text;
  for (const PosedPart& part : joint.posed->parts)
    for (const PartParameter& parameter : part.parameters)
      if (parameter.sigma > 0)
        text += fmt::format(
            ", {}.{} by {:g}{}", part.name, parameter.name, parameter.sigma,
            parameter.kind == ParameterKind::size ? "" : fmt::format(" {}", unit_of(parameter.kind)));
  return text;
}

Json parameters_json(std::span<const PosedPart> parts) {
  Json json = Json::array();
  for (const PosedPart& part : parts)
    for (const PartParameter& parameter : part.parameters)
      json.push_back({{"name", part.name + "." + parameter.name},
                      {"kind", name_of(parameter.kind)},
                      {"body", part.body == BodyRole::fixed ? "fixed" : "mobile"},
                      {"value", parameter.value},
                      {"unit", unit_of(parameter.kind)},
                      {"in_joint_file", parameter.described},
                      {"as_given", parameter.as_given},
                      {"range", {parameter.low, parameter.high}},
                      {"sigma", parameter.sigma}});
  return json;
}

Json cuts_json(std::span<const PosedPart> parts) {
  Json json = Json::array();
  for (const PosedPart& part : parts) {
    if (part.cut.empty()) continue;
    Json planes = Json::array();
    for (const CutPlane& plane : part.cut)
      planes.push_back({{"point_mm", numbers(plane.point)}, {"normal", numbers(plane.normal)}});
    json.push_back({{"part", part.name},
                    {"body", part.body == BodyRole::fixed ? "fixed" : "mobile"},
                    {"mesh", part.cut_from},
                    {"planes", std::move(planes)}});
  }
  return json;
}

}  // namespace condyle::io
