#include "io/report/joint_object.hpp"

#include <bit>
#include <cstdint>
#include <cstring>
#include <optional>
#include <utility>
#include <vector>

#include "condyle/version.hpp"
#include "io/joint/given_degrees.hpp"
#include "io/joint/ligament_tables.hpp"
#include "io/report/before_json.hpp"
#include "io/report/body_arrays.hpp"
#include "io/report/posed_json.hpp"
#include "io/report/recorded_columns.hpp"
#include "io/result/json.hpp"
#include "io/result/parameters.hpp"
#include "io/result/scope_text.hpp"

static_assert(std::endian::native == std::endian::little,
              "arrays are written as the machine has the numbers");

namespace condyle::io {
namespace {

constexpr std::uint32_t block_version = 1;

/// Numbers as in ContactRole.
std::vector<std::uint8_t> roles_of(const std::vector<motion::ContactRole>& roles) {
  std::vector<std::uint8_t> numbers;
  numbers.reserve(roles.size());
  for (const motion::ContactRole role : roles) numbers.push_back(static_cast<std::uint8_t>(role));
  return numbers;
}

Json parts_json(const Body& body) {
  Json parts = Json::array();
  for (const BodyPart& part : body.parts)
    parts.push_back({{"name", part.name},
                     {"first_vertex", part.first_vertex},
                     {"vertices", part.vertices},
                     {"first_triangle", part.first_triangle},
                     {"triangles", part.triangles},
                     {"contact", name_of(part.contact)}});
  return parts;
}

Json joint_json(const Joint& joint) {
  Json json{{"name", joint.name},
            {"kind", name_of(joint.kind)},
            {"anatomy", name_of(joint.anatomy)},
            {"side", name_of(joint.side)},
            {"fixed", joint.fixed.name},
            {"mobile", joint.mobile.name},
            {"translation_frame", name_of(joint.translation_frame)}};
  if (std::string planned = planned_text(joint); !planned.empty()) json["planned"] = std::move(planned);
  const auto& [age_years, sex, species] = joint.person;
  if (age_years) json["person"]["age"] = *age_years;
  if (sex) json["person"]["sex"] = name_of(*sex);
  if (!species.empty()) json["person"]["species"] = species;
  if (!joint.ligaments.empty()) json["ligaments"] = ligaments_text(joint.ligaments, 1);
  return json;
}

Json coordinates_json(Anatomy joint) {
  Json coordinates = Json::array();
  for (const AngleNames& names : coordinate_names(joint))
    coordinates.push_back({{"name", names.positive}, {"opposite", names.negative}});
  return coordinates;
}

/// As they were given.
Json degrees_json(const JointAngles& angles) {
  Json json = Json::array();
  for (const JointAngle angle : all_joint_angles) json.push_back(given_degrees(angle_of(angles, angle)));
  return json;
}

void append(std::string& bytes, std::uint32_t number) {
  char raw[sizeof number];
  std::memcpy(raw, &number, sizeof number);
  bytes.append(raw, sizeof number);
}

Json text_or_null(const std::optional<std::string>& text) {
  return text ? Json(*text) : Json(nullptr);
}

}  // namespace

Json joint_object(const Report& report, BlockArrays& arrays) {
  const Joint& joint = report.joint;
  add_body(arrays, "fixed", joint.fixed.mesh);
  add_body(arrays, "mobile", joint.mobile.mesh);
  if (report.rom) {
    const motion::ContactRoles& roles = report.rom->answer.bearing.roles;
    if (!roles.fixed.empty()) arrays.add("fixed_roles", roles_of(roles.fixed));
    if (!roles.mobile.empty()) arrays.add("mobile_roles", roles_of(roles.mobile));
  }
  Json json{{"version", version},
            {"title", report.title},
            {"case", text_or_null(report.labels.case_name)},
            {"note", text_or_null(report.labels.note)},
            {"date", text_or_null(report.labels.date)},
            {"joint", joint_json(joint)},
            {"coordinates", coordinates_json(joint.anatomy)},
            {"reference_deg", degrees_json(report.reference_pose.angles)},
            {"reference_mm", numbers(report.reference_pose.translation_mm)},
            {"scope", scope_text(joint)},
            {"rom", reported_rom(report.rom, report.labels)}};
  if (!report.rom) json["rom_error"] = report.rom_error;
  json["map"] = nullptr;
  json["zones"] = Json::array();
  json["layers"] = nullptr;
  json["parts"] = {{"fixed", parts_json(joint.fixed)}, {"mobile", parts_json(joint.mobile)}};
  json["poses"] = Json::array();
  json["recorded"] = nullptr;
  if (report.recorded_motion) json["recorded_motion"] = recorded_motion_json(*report.recorded_motion);
  json["measures"] = nullptr;
  json["plan"] = nullptr;
  if (has_parts_to_turn(report)) json["posed"] = posed_json(report, arrays);
  return json;
}

std::string block_of(Json json, const BlockArrays& arrays) {
  json["arrays"] = arrays.directory();
  drop_negative_zeros(json);
  std::string text = json.dump(-1, ' ', false, Json::error_handler_t::replace);
  text.resize(BlockArrays::aligned(text.size()), ' ');

  std::string block("CONDYLE\0", 8);
  append(block, block_version);
  append(block, static_cast<std::uint32_t>(text.size()));
  block.reserve(block.size() + text.size() + arrays.bytes().size());
  return block.append(text).append(arrays.bytes());
}

}  // namespace condyle::io
