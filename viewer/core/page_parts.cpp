#include "page_parts.hpp"

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "condyle/error.hpp"
#include "io/result/json.hpp"
#include "kinematics/hip_parts.hpp"
#include "kinematics/posed_parts.hpp"
#include "page_joint.hpp"

using namespace condyle;

namespace {

using io::Json;

/// The value of this name among those that a description may have.
template <class Values>
auto named(const Values& values, std::string_view name) {
  const auto found = std::find_if(std::begin(values), std::end(values),
                                  [&](const auto value) { return name_of(value) == name; });
  if (found == std::end(values)) throw UsageError("parts: " + std::string(name) + " is unknown");
  return *found;
}

std::optional<double> if_number(const Json& said) {
  return said.is_null() ? std::nullopt : std::optional(said.get<double>());
}

Vec3 vector_of(const Json& xyz) {
  return Vec3(xyz.at(0).get<double>(), xyz.at(1).get<double>(), xyz.at(2).get<double>());
}

PartParameter parameter_of(const Json& said) {
  return {.name = said.at("name"),
          .kind = named(all_parameter_kinds, said.at("kind").get<std::string>()),
          .low = said.at("range").at(0),
          .high = said.at("range").at(1),
          .value = said.at("value"),
          .described = said.at("in_joint_file"),
          .as_given = said.at("as_given"),
          .sigma = said.at("sigma"),
          .direction = vector_of(said.at("along"))};
}

PosedPart part_of(const Json& said) {
  PosedPart part{.name = said.at("name"),
                 .body = said.at("body") == "fixed" ? BodyRole::fixed : BodyRole::mobile,
                 .meshes = said.at("meshes"),
                 .centre = vector_of(said.at("centre_mm")),
                 .definition = named(all_cup_definitions, said.at("definition").get<std::string>())};
  for (const Json& parameter : said.at("parameters")) part.parameters.push_back(parameter_of(parameter));
  return part;
}

/// Drops everything that was made of the joint before.
void take(CondyleJoint& joint, Joint moved, motion::BearingOptions bearing) {
  joint.bodies = contact::JointContact(moved);
  joint.joint = std::move(moved);
  joint.bearing = std::move(bearing);
  joint.range.reset();
  joint.edit.about.reset();
  joint.counted.reset();
  joint.to_fixed.reset();
  joint.to_mobile.reset();
}

}  // namespace

int condyle_body_given(CondyleJoint* joint, int of_fixed, const char* text, const double* vertices,
                       const std::uint32_t* fitted, int fitted_count) {
  return guarded(-1, [&] {
    constexpr PartContact contacts[] = {PartContact::ends, PartContact::bearing, PartContact::soft};
    const Json said = Json::parse(text);
    Body& body = body_of(*joint, of_fixed);
    UnposedBody& given = of_fixed ? joint->parts.described.fixed : joint->parts.described.mobile;
    for (const Json& mesh : said.at("meshes"))
      body.parts.push_back({mesh.at("name"), mesh.at("first_vertex"), mesh.at("vertices"),
                            mesh.at("first_triangle"), mesh.at("triangles"),
                            named(contacts, mesh.at("contact").get<std::string>()),
                            said.at("cut_triangles").at(body.parts.size())});
    given.mesh = vertices ? body.mesh.moved_to(points_of(vertices, body.mesh.vertices().size())) : body.mesh;
    if (const Json& head = said.at("head"); !head.is_null())
      given.head = Sphere{vector_of(head.at("centre_mm")), head.at("radius_mm")};
    if (fitted) kinematics::keep_head(given.mesh, std::vector<Index>(fitted, fitted + fitted_count));
    body.bearing_margin_mm = if_number(said.at("bearing_margin_mm"));
    return 0;
  });
}

int condyle_parts(CondyleJoint* joint, const char* text) {
  return guarded(-1, [&] {
    const Json said = Json::parse(text);
    PosedParts& described = joint->parts.described;
    for (const Json& part : said.at("parts")) described.parts.push_back(part_of(part));
    kinematics::check_parts(described.parts, joint->joint.fixed, joint->joint.mobile);
    joint->joint.posed = described;
    joint->bearing.margin_mm = if_number(said.at("bearing_margin_mm"));
    joint->parts.as_described = joint->joint;
    joint->parts.bearing = joint->bearing;
    return 0;
  });
}

int condyle_set_parameters(CondyleJoint* joint, const char* text) {
  return guarded(-1, [&] {
    if (!joint->parts.as_described) throw UsageError("parts: none are described");
    const bool as_described = *text == '\0';
    Joint moved = with_parameters(*joint->parts.as_described,
                                  as_described ? std::vector<ParameterValue>{} : parse_parameters(text));
    motion::BearingOptions bearing = joint->parts.bearing;
    if (!as_described) bearing.roles.reset();
    take(*joint, std::move(moved), std::move(bearing));
    return 0;
  });
}
