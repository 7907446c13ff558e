#include "io/report/posed_json.hpp"

#include <optional>
#include <string>

#include "io/report/body_arrays.hpp"
#include "kinematics/hip_parts.hpp"

namespace condyle::io {
namespace {

Json number_or_null(const std::optional<double>& number) {
  return number ? Json(*number) : Json(nullptr);
}

Json parameter_json(const PartParameter& parameter) {
  return {{"name", parameter.name},
          {"kind", name_of(parameter.kind)},
          {"unit", unit_of(parameter.kind)},
          {"range", {parameter.low, parameter.high}},
          {"value", parameter.value},
          {"in_joint_file", parameter.described},
          {"as_given", parameter.as_given},
          {"sigma", parameter.sigma},
          {"along", numbers(parameter.direction)}};
}

Json part_json(const PosedPart& part) {
  Json parameters = Json::array();
  for (const PartParameter& parameter : part.parameters) parameters.push_back(parameter_json(parameter));
  return {{"name", part.name},
          {"body", part.body == BodyRole::fixed ? "fixed" : "mobile"},
          {"meshes", part.meshes},
          {"centre_mm", numbers(part.centre)},
          {"definition", name_of(part.definition)},
          {"is_cut", !part.cut.empty()},
          {"parameters", std::move(parameters)}};
}

/// The properties of a body that the core needs beside the mesh that the page draws.
Json body_json(const Body& body, const UnposedBody& given, const std::string& role, BlockArrays& arrays) {
  Json cut_triangles = Json::array();
  for (const BodyPart& part : body.parts) cut_triangles.push_back(part.cut_triangles);
  const auto& fitted = kinematics::fitted_head(given.mesh);
  const bool is_moved = given.mesh.vertices() != body.mesh.vertices();
  return {{"as_given", is_moved ? Json(arrays.add("given_" + role + "_vertices",
                                                  interleaved(given.mesh.vertices().view())))
                                : Json(nullptr)},
          {"head", given.head
                       ? Json{{"centre_mm", numbers(given.head->centre)}, {"radius_mm", given.head->radius}}
                       : Json(nullptr)},
          {"fitted_head",
           fitted ? Json(arrays.add("fitted_" + role + "_head", fitted->fit.vertices)) : Json(nullptr)},
          {"bearing_margin_mm", number_or_null(body.bearing_margin_mm)},
          {"cut_triangles", std::move(cut_triangles)}};
}

}  // namespace

bool has_parts_to_turn(const Report& report) noexcept {
  return report.joint.posed && report.plan == nullptr;
}

Json posed_json(const Report& report, BlockArrays& arrays) {
  const Joint& joint = report.joint;
  const PosedParts& posed = *joint.posed;
  Json parts = Json::array();
  for (const PosedPart& part : posed.parts) parts.push_back(part_json(part));
  return {{"parts", std::move(parts)},
          {"bearing_margin_mm", number_or_null(report.bearing_margin_mm)},
          {"fixed", body_json(joint.fixed, posed.fixed, "fixed", arrays)},
          {"mobile", body_json(joint.mobile, posed.mobile, "mobile", arrays)}};
}

}  // namespace condyle::io
