#include "page_parts.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "condyle/error.hpp"
#include "kinematics/hip_parts.hpp"
#include "kinematics/posed_parts.hpp"
#include "page_joint.hpp"

using namespace condyle;

namespace {

Body& body_of(CondyleJoint& joint, int of_fixed) {
  return of_fixed ? joint.joint.fixed : joint.joint.mobile;
}

/// The value of this name among those that a description may have.
template <class Values>
auto named(const Values& values, std::string_view name) {
  const auto found = std::find_if(std::begin(values), std::end(values),
                                  [&](const auto value) { return name_of(value) == name; });
  if (found == std::end(values)) throw UsageError("parts: " + std::string(name) + " is unknown");
  return *found;
}

std::optional<double> if_number(double value) {
  return std::isnan(value) ? std::nullopt : std::optional(value);
}

Mesh mesh_at(const Mesh& drawn, const double* xyz) {
  Points points;
  for (std::size_t v = 0; v < drawn.vertices().size(); ++v)
    points.push_back({xyz[3 * v], xyz[3 * v + 1], xyz[3 * v + 2]});
  return drawn.moved_to(std::move(points));
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

int condyle_body_mesh(CondyleJoint* joint, int of_fixed, const char* name, const char* contact,
                      const std::uint32_t place[5]) {
  return guarded(-1, [&] {
    constexpr PartContact contacts[] = {PartContact::ends, PartContact::bearing, PartContact::soft};
    body_of(*joint, of_fixed)
        .parts.push_back({name, place[0], place[1], place[2], place[3], named(contacts, contact), place[4]});
    return 0;
  });
}

int condyle_body_given(CondyleJoint* joint, int of_fixed, const double* vertices, const double* head,
                       const std::uint32_t* fitted, int fitted_count, double margin_mm) {
  return guarded(-1, [&] {
    Body& body = body_of(*joint, of_fixed);
    UnposedBody& given = of_fixed ? joint->parts.described.fixed : joint->parts.described.mobile;
    given.mesh = vertices ? mesh_at(body.mesh, vertices) : body.mesh;
    if (head) given.head = Sphere{Vec3(head[0], head[1], head[2]), head[3]};
    if (fitted) kinematics::keep_head(given.mesh, std::vector<Index>(fitted, fitted + fitted_count));
    body.bearing_margin_mm = if_number(margin_mm);
    return 0;
  });
}

int condyle_part(CondyleJoint* joint, const char* name, int of_fixed, const char* definition,
                 const double centre_mm[3]) {
  return guarded(-1, [&] {
    joint->parts.described.parts.push_back({.name = name,
                                            .body = of_fixed ? BodyRole::fixed : BodyRole::mobile,
                                            .centre = Vec3(centre_mm[0], centre_mm[1], centre_mm[2]),
                                            .definition = named(all_cup_definitions, definition)});
    return 0;
  });
}

int condyle_part_mesh(CondyleJoint* joint, const char* name) {
  return guarded(-1, [&] {
    joint->parts.described.parts.at(joint->parts.described.parts.size() - 1).meshes.emplace_back(name);
    return 0;
  });
}

int condyle_parameter(CondyleJoint* joint, const char* name, const char* kind, const double numbers[9]) {
  return guarded(-1, [&] {
    joint->parts.described.parts.at(joint->parts.described.parts.size() - 1)
        .parameters.push_back({.name = name,
                               .kind = named(all_parameter_kinds, kind),
                               .low = numbers[0],
                               .high = numbers[1],
                               .value = numbers[2],
                               .described = numbers[3],
                               .as_given = numbers[4],
                               .sigma = numbers[5],
                               .direction = Vec3(numbers[6], numbers[7], numbers[8])});
    return 0;
  });
}

int condyle_parts(CondyleJoint* joint, double margin_mm) {
  return guarded(-1, [&] {
    PosedParts& described = joint->parts.described;
    kinematics::check_parts(described.parts, joint->joint.fixed, joint->joint.mobile);
    joint->joint.posed = described;
    joint->bearing.margin_mm = if_number(margin_mm);
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
